// SPDX-License-Identifier: MIT
//
// Balls that a hierarchy keeps up are given up where it is repaired, and measured anew when they are wanted.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <utility>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>

#include "hierarchy/structure.hpp"
#include "hierarchy/subtree_balls.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

const Box kBox = Box::orthorhombic({20, 20, 20});

class KeptBalls : public testing::Test {
 protected:
  KeptBalls() : hierarchy_(params()) { begin_with(scenes::uniform(4000, {20, 20, 20}, 1)); }
  void begin_with(std::vector<Vec3> points) {
    points_ = std::move(points);
    hierarchy_.build(points_, kBox);
    hierarchy_.kept_view();
  }
  void move(double by) {
    for (Vec3& p : points_) p = p + random_.in_cube(by);
    hierarchy_.update(points_, kBox);
  }
  void expect_measured() {
    const detail::Structure& structure = hierarchy_.kept_view().structure();
    const detail::SubtreeBalls measured(structure);
    for (int level = 1; level <= structure.top(); ++level)
      for (std::int32_t node = 0; node < structure.levels[level].size(); ++node) {
        if (!structure.levels[level].is_alive(node)) continue;
        ASSERT_EQ(structure.balls->radius(level, node), measured.radius(level, node))
            << level << ", " << node;
      }
  }
  /// Each ball holds its points, and no block has a point outside its box.
  void expect_covering() {
    const detail::Structure& structure = hierarchy_.kept_view().structure();
    const double rounding = 1e-6;  // corners are floats
    for (std::int32_t slot = 0; slot < structure.points.size(); ++slot) {
      if (!structure.is_alive(0, slot)) continue;
      const Vec3 at = structure.points.position[static_cast<std::size_t>(slot)];
      const detail::MeasuredLeaves::Corners box = structure.balls->boxes().corners(slot / detail::kBlock);
      std::int32_t node = structure.parent(0, slot);
      const Vec3 offset = kBox.nearest_image(at - structure.levels[1].position[node]);
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_LE(box.low[axis], offset[axis] + rounding) << slot;
        ASSERT_GE(box.high[axis], offset[axis] - rounding) << slot;
      }
      for (int level = 1; node != detail::kNone; node = structure.parent(level++, node))
        ASSERT_LE(kBox.distance2(at, structure.position(level, node)),
                  std::pow(structure.balls->radius(level, node) + rounding, 2))
            << slot << " below node " << node << " of level " << level;
    }
  }
  /// The boxes of a leaf are those of the blocks in its chain, each once, and a node that is gone has none.
  void expect_boxes_of_chains() {
    const detail::Structure& structure = hierarchy_.kept_view().structure();
    const detail::Level& leaves = structure.levels[1];
    for (std::int32_t leaf = 0; leaf < leaves.size(); ++leaf) {
      std::vector<std::int32_t> boxed, chained;
      const float any = std::numeric_limits<float>::infinity();
      structure.balls->boxes().for_each_within(leaf, {}, any,
                                               [&](std::int32_t block, float) { boxed.push_back(block); });
      if (leaves.is_alive(leaf))
        for (std::int32_t block = leaves.first_child[leaf]; block != detail::kNone;
             block = structure.points.next[block])
          chained.push_back(block);
      std::sort(boxed.begin(), boxed.end());
      std::sort(chained.begin(), chained.end());
      ASSERT_EQ(boxed, chained) << leaf;
    }
  }
  /// Removes so many points, centers among them, and inserts as many.
  void exchange(int count) {
    for (int k = 0; k < count; ++k) {
      const std::int32_t id = next_++ % static_cast<std::int32_t>(points_.size());
      if (hierarchy_.contains(id)) hierarchy_.remove(id);
      hierarchy_.insert(random_.in_cube(10));
    }
  }

  std::vector<Vec3> points_;
  Hierarchy hierarchy_;

 private:
  static HierarchyParams params() {
    HierarchyParams params;
    params.radius = 1.5;
    return params;
  }
  scenes::Random random_{2};
  std::int32_t next_ = 0;
};

TEST_F(KeptBalls, AreMeasuredAnewAfterMotion) {
  move(3);
  ASSERT_FALSE(hierarchy_.repair_pending());
  expect_measured();
}

TEST_F(KeptBalls, AreMeasuredAnewWhileARepairIsPutOffAndAfterIt) {
  move(0.01);
  ASSERT_TRUE(hierarchy_.repair_pending());
  expect_measured();
  hierarchy_.repair();
  expect_measured();
}

TEST_F(KeptBalls, HoldTheirPointsAsPointsComeAndGo) {
  for (int round = 0; round < 40; ++round) {
    exchange(50);
    expect_covering();
  }
}

// A block that lost its last point serves another leaf; a query that found it in both would count points
// twice.
TEST_F(KeptBalls, HaveABoxForEachBlockThatALeafHas) {
  for (std::int32_t id = 0; id < 3600; ++id) hierarchy_.remove(id);
  expect_boxes_of_chains();
  for (const Vec3 p : scenes::uniform(2000, {10, 10, 20}, 5)) hierarchy_.insert(p);
  expect_boxes_of_chains();
}

TEST_F(KeptBalls, HoldTheirPointsWhereNewNodesStand) {
  begin_with(scenes::uniform(1000, {5, 20, 20}, 3));
  for (const Vec3 p : scenes::uniform(1000, {15, 20, 20}, 4)) hierarchy_.insert(p + Vec3{5, 0, 0});
  expect_covering();
}

// Balls of few points are as small as these allow.
TEST_F(KeptBalls, HoldTheSubtreesThatFindANewParent) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    begin_with(scenes::uniform(300, {20, 20, 20}, seed));
    for (std::int32_t id = 0; id < 250; ++id) {
      hierarchy_.remove(id);
      ASSERT_NO_FATAL_FAILURE(expect_covering()) << seed << ", " << id;
    }
  }
}

// As long as nothing asks for the leaves, balls are kept up; then all are measured at once.
TEST_F(KeptBalls, AreMeasuredAnewWhereLeavesAre) {
  exchange(500);
  hierarchy_.view();
  expect_measured();
}

}  // namespace
}  // namespace dch
