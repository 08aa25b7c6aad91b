// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include <dch/necklace/chains.hpp>

#include "error_message.hpp"

namespace {

using dch::Box;
using dch::IndexPair;
using dch::InvalidParameter;
using dch::Vec3;
using dch::necklace::Chains;
using dch::necklace::Undetermined;
using dch::necklace::unwrap;
using dch::test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::int32_t> beads(const Chains& chains, std::size_t k) {
  return {chains.beads(k).begin(), chains.beads(k).end()};
}

std::string bond_error(std::size_t particles, const std::vector<IndexPair>& bonds) {
  return message_of<InvalidParameter>([&] { Chains::from_bonds(particles, bonds); });
}

TEST(Chains, OrdersPathsAndRingsWhateverTheOrderOfTheBonds) {
  // 1-4-2 is a path, 0-5-3-6 a ring, 7 is solvent.
  const std::vector<IndexPair> bonds{{4, 2}, {6, 0}, {3, 6}, {5, 3}, {4, 1}, {0, 5}};
  const Chains chains = Chains::from_bonds(8, bonds);
  ASSERT_EQ(chains.size(), 2U);
  EXPECT_THAT(beads(chains, 0), ElementsAre(0, 5, 3, 6));
  EXPECT_TRUE(chains.closed(0));
  EXPECT_THAT(beads(chains, 1), ElementsAre(1, 4, 2));
  EXPECT_FALSE(chains.closed(1));
  EXPECT_EQ(chains.chain_of(6), 0);
  EXPECT_EQ(chains.chain_of(2), 1);
  EXPECT_EQ(chains.chain_of(7), -1);
  EXPECT_THAT(chains.bonds(), ElementsAre(IndexPair{0, 5}, IndexPair{5, 3}, IndexPair{3, 6}, IndexPair{6, 0},
                                          IndexPair{1, 4}, IndexPair{4, 2}));
}

TEST(Chains, OpenChainStartsAtItsSmallerEnd) {
  const std::vector<IndexPair> bonds{{3, 0}, {0, 2}, {2, 1}};
  EXPECT_THAT(beads(Chains::from_bonds(4, bonds), 0), ElementsAre(1, 2, 0, 3));
}

TEST(Chains, NoBondsNoChains) {
  EXPECT_EQ(Chains::from_bonds(3, {}).size(), 0U);
  EXPECT_EQ(Chains::from_bonds(0, {}).particles(), 0U);
}

TEST(Chains, RefusesGraphsThatAreNoNecklaces) {
  EXPECT_THAT(bond_error(5, {{0, 2}, {2, 1}, {4, 2}}),
              HasSubstr("bead 2 has three or more bonds (to 0, 1 and 4)"));
  EXPECT_THAT(bond_error(5, {{3, 3}}), HasSubstr("bond 3-3 joins a bead with itself"));
  EXPECT_THAT(bond_error(5, {{0, 1}, {1, 0}}), HasSubstr("bond 1-0 is given twice"));
  EXPECT_THAT(bond_error(5, {{0, 5}}), HasSubstr("bead 5 does not exist"));
  EXPECT_THAT(bond_error(5, {{-1, 0}}), HasSubstr("bead -1 does not exist"));
}

TEST(Chains, MoleculesAreChainsInOrderOfIndex) {
  const std::vector<std::int32_t> molecules{7, 0, 2, 7, 2, 7, 5};
  const Chains chains = Chains::from_molecules(molecules);
  ASSERT_EQ(chains.size(), 3U);
  EXPECT_THAT(beads(chains, 0), ElementsAre(2, 4));
  EXPECT_THAT(beads(chains, 1), ElementsAre(6));
  EXPECT_THAT(beads(chains, 2), ElementsAre(0, 3, 5));
  EXPECT_EQ(chains.chain_of(1), -1);
  EXPECT_THAT(chains.bonds(), ElementsAre(IndexPair{2, 4}, IndexPair{0, 3}, IndexPair{3, 5}));
}

TEST(Chains, RefusesNegativeMolecules) {
  const std::vector<std::int32_t> molecules{1, -3};
  EXPECT_THAT(message_of<InvalidParameter>([&] { Chains::from_molecules(molecules); }),
              HasSubstr("bead 1 has the molecule number -3"));
}

TEST(Chains, AddRefusesBadChainsAndKeepsTheOthers) {
  Chains chains(6);
  const std::vector<std::int32_t> good{0, 1, 2};
  chains.add(good);
  const auto error = [&](const std::vector<std::int32_t>& row, bool closed) {
    return message_of<InvalidParameter>([&] { chains.add(row, closed); });
  };
  EXPECT_THAT(error({3, 2}, false), HasSubstr("bead 2 stands in two chains, 0 and 1"));
  EXPECT_THAT(error({3, 4, 3}, false), HasSubstr("bead 3 stands in one chain twice"));
  EXPECT_THAT(error({3, 6}, false), HasSubstr("bead 6 does not exist"));
  EXPECT_THAT(error({}, false), HasSubstr("no bead"));
  EXPECT_THAT(error({3, 4}, true), HasSubstr("needs three at least"));
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains.chain_of(3), -1);
  const std::vector<std::int32_t> ring{3, 4, 5};
  chains.add(ring, true);
  EXPECT_THAT(beads(chains, 1), ElementsAre(3, 4, 5));
}

TEST(Unwrap, MakesAChainWholeAcrossATriclinicBox) {
  const Box box = Box::triclinic({10, 0, 0}, {4, 9, 0}, {-3, 2, 8});
  std::vector<Vec3> whole;
  for (int k = 0; k < 40; ++k) {
    whole.push_back({1 + 0.9 * k, 2 - 0.4 * k, 3 + 0.5 * std::sin(0.7 * k)});
  }
  std::vector<Vec3> wrapped;
  std::vector<std::int32_t> order;
  for (std::size_t k = 0; k < whole.size(); ++k) {
    wrapped.push_back(k == 0 ? whole[k] : box.wrap(whole[k]));
    order.push_back(static_cast<std::int32_t>(k));
  }
  Chains chains(whole.size());
  chains.add(order);
  const std::vector<Vec3> result = unwrap(chains, wrapped, box);
  for (std::size_t k = 0; k < whole.size(); ++k) {
    EXPECT_LT(norm2(result[k] - whole[k]), 1e-24) << "bead " << k;
  }
}

TEST(Unwrap, LeavesSolventAndOpenAxesAlone) {
  const Box box = Box::orthorhombic({10, 10, 10}, {true, false, true});
  const std::vector<Vec3> positions{{9.5, 9.5, 0.2}, {0.3, 10.4, 9.9}, {-25, 40, 3}};
  Chains chains(3);
  const std::vector<std::int32_t> pair{0, 1};
  chains.add(pair);
  const std::vector<Vec3> result = unwrap(chains, positions, box);
  EXPECT_EQ(result[0], positions[0]);
  EXPECT_NEAR(result[1].x, 10.3, 1e-14);
  EXPECT_EQ(result[1].y, 10.4);
  EXPECT_NEAR(result[1].z, -0.1, 1e-14);
  EXPECT_EQ(result[2], positions[2]);
}

TEST(Unwrap, WithoutABoxNothingMoves) {
  const std::vector<Vec3> positions{{0, 0, 0}, {1e6, 0, 0}};
  Chains chains(2);
  const std::vector<std::int32_t> pair{0, 1};
  chains.add(pair);
  EXPECT_EQ(unwrap(chains, positions, Box::none()), positions);
}

TEST(Unwrap, ClosesARingThatCrossesTheBoundary) {
  const Box box = Box::orthorhombic({10, 10, 10});
  const std::vector<Vec3> positions{{9.6, 5, 5}, {0.4, 5, 5}, {0.4, 5.8, 5}, {9.6, 5.8, 5}};
  const std::vector<IndexPair> bonds{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  const std::vector<Vec3> result = unwrap(Chains::from_bonds(4, bonds), positions, box);
  EXPECT_NEAR(result[1].x, 10.4, 1e-14);
  EXPECT_NEAR(result[2].x, 10.4, 1e-14);
  EXPECT_EQ(result[3], positions[3]);
}

TEST(Unwrap, RefusesARingAroundTheBox) {
  const Box box = Box::orthorhombic({9, 9, 9});
  const std::vector<Vec3> positions{{1, 5, 5}, {4, 5, 5}, {7, 5, 5}};
  const std::vector<IndexPair> bonds{{0, 1}, {1, 2}, {2, 0}};
  EXPECT_THAT(message_of<Undetermined>([&] { unwrap(Chains::from_bonds(3, bonds), positions, box); }),
              HasSubstr("the ring at bead 0 winds around"));
}

TEST(Unwrap, RefusesABondOfHalfTheBox) {
  const Box box = Box::orthorhombic({8, 20, 20});
  const std::vector<Vec3> positions{{1, 5, 5}, {5, 5, 5}};
  const std::vector<IndexPair> bonds{{0, 1}};
  const std::string message =
      message_of<Undetermined>([&] { unwrap(Chains::from_bonds(2, bonds), positions, box); });
  EXPECT_THAT(message, HasSubstr("bond 0-1 is 4.0"));
  EXPECT_THAT(message, HasSubstr("half the smallest box height"));
}

TEST(Unwrap, TellsWhichBondIsInDoubt) {
  const auto bond_of = [](const std::vector<Vec3>& positions, const std::vector<IndexPair>& bonds) {
    try {
      unwrap(Chains::from_bonds(positions.size(), bonds), positions, Box::orthorhombic({9, 9, 9}));
    } catch (const Undetermined& error) {
      return error.bond();
    }
    return IndexPair{-1, -1};
  };
  EXPECT_EQ(bond_of({{1, 5, 5}, {4, 5, 5}, {7, 5, 5}}, {{0, 1}, {1, 2}, {2, 0}}), (IndexPair{2, 0}));
  EXPECT_EQ(bond_of({{1, 5, 5}, {2, 5, 5}, {6.5, 5, 5}}, {{0, 1}, {2, 1}}), (IndexPair{1, 2}));
  EXPECT_EQ(bond_of({{1, 5, 5}, {2, 5, 5}}, {{0, 1}}), (IndexPair{-1, -1}));
}

TEST(Unwrap, RefusesAnotherNumberOfPositions) {
  const std::vector<Vec3> positions(3);
  EXPECT_THROW(unwrap(Chains(2), positions, Box::none()), InvalidParameter);
}

}  // namespace
