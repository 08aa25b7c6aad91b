// SPDX-License-Identifier: MIT
//
// Trees of points that are kept up: the work grows with what changes, and they stay as good as new ones.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/closest_pair.hpp>
#include <dch/proximity/point_tree.hpp>
#include <dch/proximity/well_separated_pairs.hpp>

#include "moving_points.hpp"
#include "point_tree_checks.hpp"

namespace dch {
namespace {

/// Of one point exchanged in each step.
struct WorkOfAStep {
  double placed, nodes, measured;
};

WorkOfAStep work_of_a_step(std::size_t points) {
  constexpr int kSteps = 400;
  MovingPoints scene(points, Box::orthorhombic({10, 10, 10}), 76);
  PointTree tree(scene.hierarchy->view());
  const PointTreeWork before = tree.work();
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<std::int32_t> changed = scene.exchange(1);
    tree.update(scene.hierarchy->kept_view(), changed);
  }
  const PointTreeWork& work = tree.work();
  EXPECT_EQ(work.builds, before.builds);
  EXPECT_EQ(work.compared - before.compared, kSteps);
  const auto mean = [&](std::int64_t from, std::int64_t to) {
    return static_cast<double>(to - from) / kSteps;
  };
  return {mean(before.placed, work.placed), mean(before.nodes, work.nodes),
          mean(before.measured, work.measured)};
}

TEST(KeptPointTrees, LookAtWhatHasChangedAlone) {
  for (const std::size_t points : {1000, 10000, 100000}) {
    const WorkOfAStep work = work_of_a_step(points);
    std::printf("%zu points: %.2f placed, %.1f nodes, %.1f points measured\n", points, work.placed,
                work.nodes, work.measured);
    const double levels = std::log2(static_cast<double>(points)) / 3;
    EXPECT_LE(work.placed, 2);
    EXPECT_LE(work.nodes, 12 * levels);
    EXPECT_LE(work.measured, 8 * levels);
  }
}

/// All points move by a thousandth of their distance: few need another place, and few balls are measured.
TEST(KeptPointTrees, MeasureFewBallsOfPointsThatAllMoveALittle) {
  constexpr std::int64_t kPoints = 20000, kSteps = 20;
  MovingPoints scene(kPoints, Box::orthorhombic({27, 27, 27}), 77);
  PointTree tree(scene.hierarchy->view());
  for (int step = 0; step < kSteps; ++step) {
    scene.shake(0.001);
    tree.update(scene.hierarchy->view());
  }
  EXPECT_EQ(tree.work().builds, 1);
  EXPECT_LE(tree.work().placed, kSteps * kPoints / 50);
  EXPECT_LE(tree.work().measured, kSteps * kPoints / 4);
  EXPECT_EQ(tree.work().compared, kSteps * kPoints);
}

/// The share of points whose balls are larger, and pairs, after each point was exchanged five times in the
/// mean and all have moved far, step by step.
TEST(KeptPointTrees, StayAsGoodAsNewOnes) {
  MovingPoints scene(5000, Box::orthorhombic({17, 17, 17}), 78);
  PointTree tree(scene.hierarchy->view());
  const auto check = [&](const char* what) {
    const PointTree anew(scene.hierarchy->view());
    const auto pairs_of = [](const PointTree& of) {
      return static_cast<double>(well_separated_pairs(of, 1).pairs.size());
    };
    const auto looked_at = [](const PointTree& of) {
      return static_cast<double>(closest_pair(of).looked_at);
    };
    std::printf(
        "%s: %.3f of the pairs, %.3f of the work of the closest pair, %.3f of the nodes\n", what,
        pairs_of(tree) / pairs_of(anew), looked_at(tree) / looked_at(anew),
        static_cast<double>(nodes_from_the_root(tree).size()) / static_cast<double>(anew.nodes().size()));
    EXPECT_LE(pairs_of(tree), 1.25 * pairs_of(anew)) << what;
    EXPECT_LE(looked_at(tree), 1.4 * looked_at(anew)) << what;
  };
  for (int step = 0; step < 250; ++step) {
    const std::vector<std::int32_t> changed = scene.exchange(100);
    tree.update(scene.hierarchy->kept_view(), changed);
  }
  check("exchanged");
  for (int step = 0; step < 200; ++step) {
    scene.shake(0.005);
    tree.update(scene.hierarchy->view());
  }
  check("moved");
  EXPECT_LE(tree.work().builds, 20);
}

}  // namespace
}  // namespace dch
