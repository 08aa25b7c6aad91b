// SPDX-License-Identifier: MIT
//
// Balls that a hierarchy keeps up are given up where it is repaired, and measured anew when they are wanted.
#include <gtest/gtest.h>
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
  KeptBalls() : points_(scenes::uniform(4000, {20, 20, 20}, 1)), hierarchy_(params()) {
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

  std::vector<Vec3> points_;
  Hierarchy hierarchy_;

 private:
  static HierarchyParams params() {
    HierarchyParams params;
    params.radius = 1.5;
    return params;
  }
  scenes::Random random_{2};
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

}  // namespace
}  // namespace dch
