// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <tuple>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/necklace/crossings.hpp>
#include <dch/necklace/melt.hpp>

#include "effort.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace {

using dch::Box;
using dch::IndexPair;
using dch::Vec3;
using dch::necklace::bond_encounter;
using dch::necklace::BondCrossing;
using dch::necklace::Chains;
using dch::necklace::CrossingFinder;
using dch::necklace::CrossingFinderParams;
using dch::necklace::MovingBond;
using dch::necklace::StepCrossings;
using dch::scenes::Random;

/// Random walks, and where they go; unwrapped.
struct Walks {
  Chains chains{0};
  std::vector<Vec3> positions;
};

Walks random_walks(Random& random, int chains, int beads, double bond, double side) {
  Walks walks;
  walks.chains = Chains(static_cast<std::size_t>(chains * beads));
  for (int k = 0; k < chains; ++k) {
    std::vector<std::int32_t> members;
    Vec3 at = random.in_cube(0.5 * side);
    for (int n = 0; n < beads; ++n) {
      members.push_back(static_cast<std::int32_t>(walks.positions.size()));
      walks.positions.push_back(at);
      const Vec3 step = random.in_ball(1);
      at = at + (bond / std::sqrt(norm2(step))) * step;
    }
    walks.chains.add(members, k % 2 == 1);
  }
  // Rings close with a bond that may be long: draw their beads together.
  for (std::size_t k = 1; k < walks.chains.size(); k += 2) {
    const auto ring = walks.chains.beads(k);
    for (const std::int32_t bead : ring) {
      const Vec3 first = walks.positions[static_cast<std::size_t>(ring[0])];
      Vec3& p = walks.positions[static_cast<std::size_t>(bead)];
      p = first + 0.25 * (p - first);
    }
  }
  return walks;
}

std::vector<Vec3> wrapped(const std::vector<Vec3>& positions, const Box& box) {
  std::vector<Vec3> result;
  for (const Vec3 p : positions) result.push_back(box.wrap(p));
  return result;
}

/// All pairs of bonds in all images, of unwrapped motion.
std::vector<BondCrossing> all_pairs(const std::vector<IndexPair>& bonds, const std::vector<Vec3>& from,
                                    const std::vector<Vec3>& to, const Box& box) {
  std::vector<BondCrossing> found;
  const auto at = [](const std::vector<Vec3>& positions, std::int32_t k) {
    return positions[static_cast<std::size_t>(k)];
  };
  const auto shifts = [&](int axis) { return box.periodic(axis) ? 3 : 0; };
  for (std::size_t p = 0; p < bonds.size(); ++p) {
    for (std::size_t q = p + 1; q < bonds.size(); ++q) {
      const IndexPair P = bonds[p], Q = bonds[q];
      if (P[0] == Q[0] || P[0] == Q[1] || P[1] == Q[0] || P[1] == Q[1]) continue;
      for (int a = -shifts(0); a <= shifts(0); ++a) {
        for (int b = -shifts(1); b <= shifts(1); ++b) {
          for (int c = -shifts(2); c <= shifts(2); ++c) {
            const Vec3 s = a * box.vector(0) + (b * box.vector(1) + c * box.vector(2));
            const auto encounter =
                bond_encounter({at(from, P[0]), at(from, P[1]), at(to, P[0]), at(to, P[1])},
                               {at(from, Q[0]) + s, at(from, Q[1]) + s, at(to, Q[0]) + s, at(to, Q[1]) + s});
            for (int k = 0; k < encounter.count; ++k) {
              BondCrossing crossing;
              static_cast<dch::necklace::Crossing&>(crossing) =
                  encounter.crossings[static_cast<std::size_t>(k)];
              crossing.p = static_cast<std::int32_t>(p);
              crossing.q = static_cast<std::int32_t>(q);
              found.push_back(crossing);
            }
          }
        }
      }
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::tuple(a.p, a.q, a.time) < std::tuple(b.p, b.q, b.time);
  });
  return found;
}

void expect_same(const std::vector<BondCrossing>& found, const std::vector<BondCrossing>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(std::tuple(found[k].p, found[k].q, found[k].sign),
              std::tuple(expected[k].p, expected[k].q, expected[k].sign));
    EXPECT_NEAR(found[k].time, expected[k].time, 1e-8);
    EXPECT_NEAR(found[k].on_p, expected[k].on_p, 1e-6);
    EXPECT_NEAR(found[k].on_q, expected[k].on_q, 1e-6);
  }
}

std::vector<IndexPair> bonds_of(const CrossingFinder& finder) {
  return {finder.bonds().begin(), finder.bonds().end()};
}

class InEveryBox : public testing::TestWithParam<dch::scenes::NamedBox> {};

/// A host that gives positions in the box and one that does not, steps that are small, and one with a bead
/// that goes far.
TEST_P(InEveryBox, FinderEqualsAllPairs) {
  const Box box = GetParam().box;
  Random random(5);
  std::size_t crossings = 0;
  for (const double speed : {0.05, 0.3}) {
    const Walks walks = random_walks(random, 4, 10, 0.8, 5);
    CrossingFinder inside(walks.chains), anywhere(walks.chains);
    std::vector<Vec3> from = walks.positions;
    inside.start(wrapped(from, box), box);
    anywhere.start(from, box);
    for (int step = 0; step < 3; ++step) {
      std::vector<Vec3> to = from;
      for (Vec3& p : to) p = p + random.in_ball(speed);
      to[3] = to[3] + random.in_ball(step == 1 ? 1.0 : speed);
      const auto expected = all_pairs(bonds_of(inside), from, to, box);
      const StepCrossings& found = inside.step(wrapped(to, box), box);
      EXPECT_TRUE(found.undetermined.empty());
      expect_same(found.crossings, expected);
      expect_same(anywhere.step(to, box).crossings, expected);
      crossings += expected.size();
      from = to;
    }
  }
  std::cout << crossings << " crossings, seed 5\n";
  EXPECT_GT(crossings, 5U);
}

INSTANTIATE_TEST_SUITE_P(Crossings, InEveryBox, testing::ValuesIn(dch::scenes::all_boxes(6)),
                         [](const auto& scene) { return scene.param.name; });

TEST(CrossingFinder, ThroughEveryFaceAsInTheMiddle) {
  const Box box = Box::triclinic({6, 0, 0}, {1.5, 6, 0}, {-1, 2, 6});
  const Chains chains = Chains::from_bonds(4, std::vector<IndexPair>{{0, 1}, {2, 3}});
  Random random(9);
  for (int k = 0; k < 60; ++k) {
    const Vec3 by = random.in_cube(12);
    const auto placed = [&](double height) {
      return wrapped({by + Vec3{-0.5, 0, 0}, by + Vec3{0.5, 0, 0}, by + Vec3{0, -0.5, height},
                      by + Vec3{0.1, 0.5, height}},
                     box);
    };
    CrossingFinder finder(chains);
    finder.start(placed(0.75), box);
    const StepCrossings& found = finder.step(placed(-0.25), box);
    ASSERT_EQ(found.crossings.size(), 1U);
    EXPECT_NEAR(found.crossings[0].time, 0.75, 1e-9);
    EXPECT_EQ(found.crossings[0].sign, 1);
    EXPECT_TRUE(finder.step(placed(-0.75), box).crossings.empty());
  }
}

TEST(CrossingFinder, AChangeOfTheBoxAloneMakesNoCrossing) {
  Random random(21);
  const Walks walks = random_walks(random, 6, 10, 0.8, 5);
  const Box box = Box::triclinic({6, 0, 0}, {0.4, 6.5, 0}, {-0.3, 0.2, 7});
  const auto mapped = [](Vec3 v) {
    return Vec3{1.06 * v.x + 0.05 * v.y, 0.97 * v.y, 1.1 * v.z + 0.04 * v.x};
  };
  const Box after = Box::triclinic(mapped(box.vector(0)), mapped(box.vector(1)), mapped(box.vector(2)));
  std::vector<Vec3> to = wrapped(walks.positions, box);
  for (Vec3& p : to) p = mapped(p);
  CrossingFinder finder(walks.chains);
  finder.start(wrapped(walks.positions, box), box);
  const StepCrossings& found = finder.step(wrapped(to, after), after);
  EXPECT_TRUE(found.crossings.empty());
  EXPECT_TRUE(found.undetermined.empty());
  EXPECT_GT(found.stats.near_pairs, 20);
}

TEST(CrossingFinder, ACellGivenByOtherVectorsOfItsLatticeIsTheSame) {
  Random random(22);
  const Walks walks = random_walks(random, 16, 12, 0.9, 6);
  const Box before = Box::triclinic({6, 0, 0}, {3.1, 6, 0}, {0, 0, 6});
  const Box flipped = Box::triclinic({6, 0, 0}, {-2.9, 6, 0}, {0, 0, 6});
  std::vector<Vec3> to = walks.positions;
  for (Vec3& p : to) p = p + random.in_ball(0.6);
  CrossingFinder finder(walks.chains);
  finder.start(wrapped(walks.positions, before), before);
  const std::vector<BondCrossing> expected = finder.step(wrapped(to, before), before).crossings;
  finder.start(wrapped(walks.positions, before), before);
  const StepCrossings& found = finder.step(wrapped(to, flipped), flipped);
  EXPECT_TRUE(found.undetermined.empty());
  expect_same(found.crossings, expected);
  EXPECT_GT(expected.size(), 0U);
}

TEST(CrossingFinder, ThreadsFindTheSame) {
  Random random(23);
  const Walks walks = random_walks(random, 40, 20, 0.9, 8);
  const Box box = Box::orthorhombic({8, 8, 8});
  std::vector<Vec3> to = walks.positions;
  for (Vec3& p : to) p = p + random.in_ball(0.4);
  const auto pool = dch::make_thread_pool(3);
  CrossingFinderParams params;
  params.thickness = 0.05;
  CrossingFinder one(walks.chains, params);
  params.executor = pool.get();
  CrossingFinder several(walks.chains, params);
  one.start(walks.positions, box);
  several.start(walks.positions, box);
  const StepCrossings a = one.step(to, box), b = several.step(to, box);
  ASSERT_EQ(a.crossings.size(), b.crossings.size());
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  EXPECT_GT(a.crossings.size(), 10U);
  EXPECT_GT(a.contacts.size(), a.crossings.size());
  for (std::size_t k = 0; k < a.crossings.size(); ++k) {
    EXPECT_EQ(std::tuple(a.crossings[k].p, a.crossings[k].q, a.crossings[k].time, a.crossings[k].on_p),
              std::tuple(b.crossings[k].p, b.crossings[k].q, b.crossings[k].time, b.crossings[k].on_p));
  }
  EXPECT_EQ(a.stats.by_zonotope, b.stats.by_zonotope);
}

/// The counts fail if a filter stops rejecting, or rejects what is not its to reject.
TEST(CrossingFinder, FiltersRejectNearlyAllPairsOfAMelt) {
  dch::necklace::MeltParams params;
  params.chains = 40;
  params.beads_per_chain = 50;
  const dch::necklace::Melt melt = dch::necklace::make_melt(params);
  Random random(31);
  std::vector<Vec3> to = melt.positions;
  for (Vec3& p : to) p = p + random.in_ball(0.1);
  CrossingFinder finder(Chains::from_bonds(melt.positions.size(), melt.bonds));
  finder.start(melt.positions, melt.box);
  const dch::necklace::StepCrossings& found = finder.step(to, melt.box);
  const auto& stats = found.stats;
  const std::int64_t left = stats.near_pairs - stats.by_ball - stats.by_box - stats.by_zonotope;
  std::cout << stats.bonds << " bonds, " << stats.near_pairs << " near pairs, ball " << stats.by_ball
            << ", box " << stats.by_box << ", zonotope " << stats.by_zonotope << ", left " << left
            << ", crossings " << found.crossings.size() << "\n";
  EXPECT_EQ(stats.bonds, 40 * 49);
  EXPECT_LT(left, stats.near_pairs / 20);
  EXPECT_GT(stats.by_zonotope, (stats.near_pairs - stats.by_ball - stats.by_box) / 2);
  EXPECT_GT(stats.by_box, stats.near_pairs / 10);
  EXPECT_LT(stats.near_pairs, 10 * stats.bonds);
  EXPECT_EQ(stats.exact, 0);
}

/// With the search; the last positions, the bonds, and what a step needs.
TEST(CrossingFinder, HoldsAtMostAHundredBytesABond) {
  dch::necklace::MeltParams params;
  params.chains = 200;
  const dch::necklace::Melt melt = dch::necklace::make_melt(params);
  Random random(32);
  std::vector<Vec3> to = melt.positions;
  for (Vec3& p : to) p = p + random.in_ball(0.1);
  CrossingFinder finder(Chains::from_bonds(melt.positions.size(), melt.bonds));
  finder.start(melt.positions, melt.box);
  finder.step(to, melt.box);
  finder.step(melt.positions, melt.box);
  EXPECT_LE(finder.memory_bytes(), 100 * finder.bonds().size());
  EXPECT_GE(finder.memory_bytes(), (sizeof(Vec3) + sizeof(dch::IndexPair)) * finder.bonds().size());
}

}  // namespace
