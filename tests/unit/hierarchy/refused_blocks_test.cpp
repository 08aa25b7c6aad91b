// SPDX-License-Identifier: MIT
//
// Points that come apart may need more blocks than indices name, whatever is done to them. Here few are
// allowed.
#include <gtest/gtest.h>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/lists/all_pairs.hpp>

#include "hierarchy_test_access.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

/// Leaves of a few points, or gas most of whose points stand on their own.
class RefusedBlocks : public ::testing::Test {
 protected:
  static constexpr std::size_t kPoints = 100;

  RefusedBlocks() : hierarchy_(params()) { hierarchy_.build(points_, box_); }
  void expand(double edge) {
    box_ = Box::orthorhombic({edge, edge, edge});
    points_ = scenes::uniform_in(box_, kPoints, 5);
    hierarchy_.build(points_, box_);
  }

  static StructureParams params() {
    StructureParams params;
    params.radius = 1;
    params.base_radius = 1;
    params.max_roots = 4;
    return params;
  }
  void allow_blocks_there_are() {
    auto& points = HierarchyTestAccess::impl(hierarchy_).points;
    points.most = static_cast<std::int64_t>(points.leaf.size());
  }
  void expect_right(const std::vector<Vec3>& points) {
    ListParams params;
    params.cutoffs = TypeCutoffs(1);
    NeighborList list;
    hierarchy_.list(params, list);
    EXPECT_EQ(first_difference(list, all_pairs(points, box_, params)), "");
  }
  void expect_empty_and_usable() {
    EXPECT_EQ(hierarchy_.size(), 0u);
    EXPECT_EQ(hierarchy_.validate(), "");
    HierarchyTestAccess::impl(hierarchy_).points.most = detail::kMaxBlocks;
    hierarchy_.build(points_, box_);
    expect_right(points_);
  }

  Box box_ = Box::orthorhombic({6, 6, 6});
  std::vector<Vec3> points_ = scenes::uniform_in(box_, kPoints, 5);
  ListedHierarchy hierarchy_;
};

TEST_F(RefusedBlocks, InsertChangesNothing) {
  allow_blocks_there_are();
  EXPECT_THROW(hierarchy_.insert({1, 1, 1}), InvalidParameter);
  EXPECT_EQ(hierarchy_.size(), kPoints);
  EXPECT_EQ(hierarchy_.validate(), "");
  expect_right(points_);
}

// Two points that shared the block of their center are each a leaf without it.
TEST_F(RefusedBlocks, RemoveLeavesItEmpty) {
  hierarchy_.build(std::vector<Vec3>{{3, 3, 3}}, box_);
  hierarchy_.insert({3.9, 3, 3});
  hierarchy_.insert({2.1, 3, 3});
  allow_blocks_there_are();
  EXPECT_THROW(hierarchy_.remove(0), InvalidParameter);
  expect_empty_and_usable();
}

TEST_F(RefusedBlocks, UpdateLeavesItEmpty) {
  const std::vector<Vec3> apart = scenes::uniform_in(box_, kPoints, 6);
  allow_blocks_there_are();
  EXPECT_THROW(hierarchy_.update(apart, box_), InvalidParameter);
  expect_empty_and_usable();
}

// A point so far outside that its place is uncertain by more than the edges allow for has the hierarchy
// repaired. Room for that is asked for before anything changes.
TEST_F(RefusedBlocks, InsertionFarOutsideChangesNothing) {
  expand(80);
  const Vec3 far_outside{2e14, 0, 0};
  allow_blocks_there_are();
  EXPECT_THROW(hierarchy_.insert(far_outside), InvalidParameter);
  EXPECT_EQ(hierarchy_.size(), kPoints);
  EXPECT_EQ(hierarchy_.stats().repairs, 0);
  expect_right(points_);
  HierarchyTestAccess::impl(hierarchy_).points.most = detail::kMaxBlocks;
  hierarchy_.insert(far_outside);
  EXPECT_EQ(hierarchy_.stats().repairs, 1);
  EXPECT_EQ(hierarchy_.validate(), "");
  std::vector<Vec3> all = points_;
  all.push_back(far_outside);
  expect_right(all);
}

}  // namespace
}  // namespace dch
