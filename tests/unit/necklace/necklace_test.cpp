// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <string>
#include <vector>

#include <dch/necklace/necklace.hpp>

#include "error_message.hpp"

namespace {

using dch::Box;
using dch::IndexPair;
using dch::InvalidParameter;
using dch::InvalidPosition;
using dch::Vec3;
using dch::necklace::Chains;
using dch::necklace::Necklace;
using dch::necklace::NecklaceLimits;
using dch::necklace::NecklaceMeasure;
using dch::necklace::NotANecklace;
using dch::test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;

const double kPi = std::acos(-1.0);

/// Particle 3 is solvent; the ring is 4-5-6-7, the chain 2-0-1.
Necklace ring_and_chain() {
  Chains chains(8);
  chains.add(std::vector<std::int32_t>{4, 5, 6, 7}, true);
  chains.add(std::vector<std::int32_t>{2, 0, 1});
  return Necklace(chains, {1, 2, 3, 100, 4, 5, 6, 7});
}

TEST(NecklaceTest, PlacesFollowTheChains) {
  const Necklace necklace = ring_and_chain();
  EXPECT_EQ(necklace.size(), 7U);
  EXPECT_EQ(necklace.particles(), 8U);
  EXPECT_THAT(std::vector<std::int32_t>(necklace.particle().begin(), necklace.particle().end()),
              ElementsAre(4, 5, 6, 7, 2, 0, 1));
  EXPECT_EQ(necklace.first_place(1), 4);
  EXPECT_EQ(necklace.first_place(2), 7);
  EXPECT_EQ(necklace.chain_at(3), 0U);
  EXPECT_EQ(necklace.chain_at(4), 1U);
  EXPECT_EQ(necklace.largest_radius(), 7) << "the solvent has no say";
}

TEST(NecklaceTest, CountsBondsAlongChainsAndAroundRings) {
  const Necklace necklace = ring_and_chain();
  EXPECT_EQ(necklace.bonds_between(0, 3), 1);
  EXPECT_EQ(necklace.bonds_between(3, 1), 2);
  EXPECT_EQ(necklace.bonds_between(4, 6), 2);
  EXPECT_EQ(necklace.bonds_between(2, 2), 0);
  EXPECT_EQ(necklace.bonds_between(3, 4), -1);
  EXPECT_EQ(necklace.bonds_between(4, 3), -1);
}

TEST(NecklaceTest, MeasuresTheConstants) {
  const Necklace necklace = Necklace::chain({3, 4, 2});
  // Radii 3 and 4 at distance 5 meet at a right angle; 4 and 2 leave a gap of 1.
  const NecklaceMeasure m = necklace.measure(std::vector<Vec3>{{0, 0, 0}, {5, 0, 0}, {5, 7, 0}}, Box::none());
  EXPECT_DOUBLE_EQ(m.alpha, 2);
  EXPECT_NEAR(m.beta, kPi / 2, 1e-15);
  EXPECT_EQ(m.deepest_overlap, (IndexPair{0, 1}));
  EXPECT_DOUBLE_EQ(m.largest_gap, 1);
  EXPECT_EQ(m.widest_gap, (IndexPair{1, 2}));
  EXPECT_DOUBLE_EQ(m.shortest_bond, 5);
  EXPECT_DOUBLE_EQ(m.longest_bond, 7);
}

TEST(NecklaceTest, MeasuresAcrossTheBoundaryAndTheClosingBond) {
  const Necklace necklace = Necklace::chain({0.5, 0.5, 0.5}, true);
  const NecklaceMeasure m = necklace.measure(std::vector<Vec3>{{9.75, 5, 5}, {0.25, 5, 5}, {0.25, 6, 5}},
                                             Box::orthorhombic({10, 10, 10}));
  EXPECT_NEAR(m.shortest_bond, 0.5, 1e-14);
  EXPECT_NEAR(m.longest_bond, std::sqrt(1.25), 1e-14);
  EXPECT_EQ(m.widest_gap, (IndexPair{2, 0}));
  EXPECT_NEAR(m.beta, std::acos((0.5 - 0.25) / 0.5), 1e-14);
}

TEST(NecklaceTest, MeasuresBeadsInsideOthersAndPoints) {
  const Necklace inside = Necklace::chain({3, 1});
  EXPECT_EQ(inside.measure(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}, Box::none()).beta, 0);
  const Necklace points = Necklace::chain({0, 0});
  const NecklaceMeasure m = points.measure(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}, Box::none());
  EXPECT_EQ(m.alpha, 1);
  EXPECT_DOUBLE_EQ(m.beta, kPi);
  const Necklace mixed = Necklace::chain({0, 1});
  EXPECT_EQ(mixed.measure(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}, Box::none()).alpha,
            std::numeric_limits<double>::infinity());
}

TEST(NecklaceTest, WithoutBondsThereIsNothingToBreak) {
  for (const std::size_t beads : {0U, 1U}) {
    const Necklace necklace = Necklace::chain(std::vector<double>(beads, 1.0));
    const NecklaceMeasure m = necklace.measure(std::vector<Vec3>(beads), Box::none());
    EXPECT_EQ(m.alpha, 1);
    EXPECT_DOUBLE_EQ(m.beta, kPi);
    EXPECT_EQ(m.largest_gap, 0);
    EXPECT_NO_THROW(require(m, {1, 3, 0, 1}));
  }
}

TEST(NecklaceTest, RequireNamesWhatIsBroken) {
  const Necklace necklace = Necklace::chain({3, 4, 2});
  const NecklaceMeasure m = necklace.measure(std::vector<Vec3>{{0, 0, 0}, {5, 0, 0}, {5, 7, 0}}, Box::none());
  EXPECT_NO_THROW(require(m, {}));
  EXPECT_NO_THROW(require(m, {2, kPi / 2 - 1e-9, 1, 1.4}));
  const auto message = [&](const NecklaceLimits& limits) {
    return message_of<NotANecklace>([&] { require(m, limits); });
  };
  NecklaceLimits limits;
  limits.max_alpha = 1.5;
  EXPECT_THAT(message(limits), HasSubstr("2.000000 times the smallest, the limit is 1.500000"));
  limits = {};
  limits.min_beta = 2;
  EXPECT_THAT(message(limits), HasSubstr("bond 0-1 lets beads overlap to an angle of 1.570796"));
  limits = {};
  limits.max_gap = 0;
  EXPECT_THAT(message(limits), HasSubstr("bond 1-2 leaves a gap of 1.000000"));
  limits = {};
  limits.max_bond_ratio = 1.2;
  EXPECT_THAT(message(limits), HasSubstr("from 5.000000 to 7.000000 long"));
}

TEST(NecklaceTest, RefusesBadRadiiAndPositions) {
  const auto radii_error = [](std::vector<double> radii) {
    return message_of<InvalidParameter>([&] { Necklace(Chains(2), radii); });
  };
  EXPECT_THAT(radii_error({1}), HasSubstr("there are 1 radii for chains over 2 particles"));
  EXPECT_THAT(radii_error({1, -1}), HasSubstr("the radius of bead 1 is -1"));
  EXPECT_THAT(radii_error({std::nan(""), 1}), HasSubstr("the radius of bead 0 is"));
  EXPECT_THAT(radii_error({1, std::numeric_limits<double>::infinity()}), HasSubstr("radius of bead 1"));
  const Necklace necklace = Necklace::chain({1, 1});
  EXPECT_THAT(message_of<InvalidParameter>([&] { necklace.measure(std::vector<Vec3>(3), Box::none()); }),
              HasSubstr("there are 3 positions for a necklace of 2 particles"));
  EXPECT_THAT(message_of<InvalidPosition>([&] {
                necklace.measure(std::vector<Vec3>{{0, 0, 0}, {0, std::nan(""), 0}}, Box::none());
              }),
              HasSubstr("bead 1 has the coordinate"));
}

}  // namespace
