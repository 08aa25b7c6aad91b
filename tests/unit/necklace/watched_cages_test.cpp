// SPDX-License-Identifier: MIT
// Verification::watched: large cages of which only the beads farthest out are looked at.
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include <dch/necklace/shapes.hpp>
#include <dch/necklace/walks.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "cage_check.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace {

using dch::Box;
using dch::Vec3;
using dch::necklace::Necklace;
using dch::necklace::necklace_of;
using dch::necklace::Shape;
using dch::necklace::Verification;
using dch::necklace::WrappedHierarchy;
using dch::test::fault;

void shake_beads(std::vector<Vec3>& positions, double by, std::uint64_t seed) {
  dch::scenes::Random random(seed);
  for (Vec3& p : positions) p = p + random.in_ball(by);
}

std::vector<double> radii(std::size_t n, bool even) {
  std::vector<double> result(n, 0.4);
  for (std::size_t k = 0; k < n && !even; ++k) result[k] = 0.1 + 0.3 * double(k % 7) / 6;
  return result;
}

/// The first node whose basis is another one in the two hierarchies; -1 if there is none.
std::int32_t first_difference(const WrappedHierarchy& a, const WrappedHierarchy& b) {
  for (std::size_t k = 0; k < a.bases().size(); ++k) {
    if (a.bases()[k] != b.bases()[k]) return static_cast<std::int32_t>(k);
  }
  return -1;
}

TEST(WatchedCages, HaveTheBasesThatTheNaiveWayFinds) {
  for (const bool even : {true, false}) {
    for (const double step : {1e-9, 1e-3, 0.02, 0.3, 20.0}) {
      Shape walk = dch::necklace::random_walk(700, 5);
      WrappedHierarchy watched(Necklace::chain(radii(700, even)), {8, Verification::watched});
      WrappedHierarchy naive(Necklace::chain(radii(700, even)), {8, Verification::naive});
      for (std::uint64_t k = 0; k < 20; ++k) {
        watched.update(walk.positions, Box::none());
        naive.update(walk.positions, Box::none());
        ASSERT_EQ(first_difference(watched, naive), -1) << "step " << step << ", update " << k;
        ASSERT_EQ(fault(watched), "") << "step " << step << ", update " << k;
        shake_beads(walk.positions, step, k);
      }
      EXPECT_EQ(watched.stats().escapes, naive.stats().escapes);
      EXPECT_EQ(watched.stats().basis_changes, naive.stats().basis_changes);
      EXPECT_EQ(naive.stats().looks, 0);
    }
  }
}

TEST(WatchedCages, ABeadFromDeepInsideIsFound) {
  // One bead at a time comes out of a ball of beads at rest, by small steps or at once.
  for (const int steps : {1, 7, 200}) {
    Shape globule = dch::necklace::globule(600, 0.1, 2);
    WrappedHierarchy watched(necklace_of(globule, 0.4), {8, Verification::watched});
    watched.build(globule.positions, Box::none());
    for (std::size_t bead = 3; bead < 600; bead += 97) {
      const Vec3 before = globule.positions[bead];
      for (int step = 1; step <= steps; ++step) {
        globule.positions[bead] = before + (12.0 * step / steps) * Vec3{0.6, 0, 0.8};
        watched.update(globule.positions, Box::none());
      }
      ASSERT_EQ(fault(watched), "") << "bead " << bead << " in " << steps << " steps";
      globule.positions[bead] = before;
    }
  }
}

TEST(WatchedCages, AreLookedAtOnceAsLongAsNothingMoves) {
  const Shape walk = dch::necklace::self_avoiding_walk(1000, 1, 3);
  WrappedHierarchy watched(necklace_of(walk, 0.4), {8, Verification::watched});
  watched.build(walk.positions, Box::none());
  EXPECT_EQ(watched.stats().looks, 0);
  std::int64_t large = 0;
  for (const auto& node : watched.trees().nodes()) large += node.count > 32 ? 1 : 0;
  ASSERT_GT(large, 0);
  for (int k = 0; k < 5; ++k) {
    watched.update(walk.positions, Box::none());
    EXPECT_EQ(watched.stats().looks, large) << "update " << k;
  }
  // What was learned before a build is forgotten by it.
  watched.build(walk.positions, Box::none());
  watched.update(walk.positions, Box::none());
  EXPECT_EQ(watched.stats().looks, 2 * large);
}

TEST(WatchedCages, AreSeldomLookedAtUnderSmallSteps) {
  Shape walk = dch::necklace::self_avoiding_walk(4096, 1, 4);
  WrappedHierarchy watched(necklace_of(walk, 0.4), {8, Verification::watched});
  constexpr int kUpdates = 40;
  for (std::uint64_t k = 0; k <= kUpdates; ++k) {
    watched.update(walk.positions, Box::none());
    shake_beads(walk.positions, 0.02, k);
  }
  EXPECT_EQ(fault(watched), "");
  const auto& stats = watched.stats();
  EXPECT_EQ(stats.updates, kUpdates);
  EXPECT_LT(stats.containment_tests, std::int64_t{6} * kUpdates * 4096);
  EXPECT_GT(stats.looks, 0);
}

TEST(WatchedCages, FollowChainsThroughEveryBox) {
  for (const auto& scene : dch::scenes::all_boxes(6)) {
    Shape walk = dch::necklace::random_walk(200, 12);
    WrappedHierarchy watched(necklace_of(walk, 0.3), {8, Verification::watched});
    for (std::uint64_t k = 0; k < 10; ++k) {
      std::vector<Vec3> wrapped_in;
      for (const Vec3& p : walk.positions) wrapped_in.push_back(scene.box.wrap(p));
      watched.update(wrapped_in, scene.box);
      ASSERT_EQ(fault(watched), "") << scene.name << ", update " << k;
      shake_beads(walk.positions, 0.05, k);
      // The whole chain drifts through the faces.
      for (Vec3& p : walk.positions) p = p + Vec3{0.3, -0.2, 0.1};
    }
  }
}

TEST(WatchedCages, CoincidentAndFlatChains) {
  const std::vector<Shape> shapes{{std::vector<Vec3>(100, {1, 2, 3}), false},
                                  dch::necklace::grid_necklace(128, 1, 1),
                                  dch::necklace::grid_necklace(12, 12, 1),
                                  dch::necklace::grid_necklace(6, 6, 6)};
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    for (const double radius : {0.0, 0.49}) {
      Shape shape = shapes[k];
      WrappedHierarchy watched(necklace_of(shape, radius), {8, Verification::watched});
      for (std::uint64_t update = 0; update < 4; ++update) {
        watched.update(shape.positions, Box::none());
        ASSERT_EQ(fault(watched), "") << "shape " << k << ", radius " << radius << ", update " << update;
        if (update == 1) shake_beads(shape.positions, 1e-3, 1);
        if (update == 2) shape.positions = shapes[k].positions;
      }
    }
  }
}

}  // namespace
