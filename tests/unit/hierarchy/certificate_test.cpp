// SPDX-License-Identifier: MIT
//
// The certificate under which repair is put off: each of its clauses in a scene in which it alone stands
// between the list and a missing pair, and the limit itself to the last digit.
//
// More than 300 lines: all scenes start from the fixture that sets one clause against another.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <dch/lists/all_pairs.hpp>

#include "hierarchy_test_access.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kListRadius = 1;

/// R_0 = 1, so rho_1 = 3.8: leaves may use up (3.8 - 1) / 2 = 1.4 with their extent and their motion.
StructureParams params_with(int max_roots) {
  StructureParams params;
  params.radius = kListRadius;
  params.base_radius = 1;
  params.max_roots = max_roots;
  return params;
}

/// Points that move, and what a hierarchy makes of them.
class Certificate : public ::testing::Test {
 protected:
  /// The first points become centers of level 1 if they are more than R_0 apart, whatever comes after them.
  void start(const std::vector<Vec3>& centers, const std::vector<Vec3>& others, int max_roots = 16,
             const Box& box = Box::none()) {
    hierarchy_ = ListedHierarchy(params_with(max_roots));
    box_ = box;
    points_ = centers;
    hierarchy_.build(points_, box_);
    for (const Vec3 p : others) {
      points_.push_back(p);
      hierarchy_.insert(p);
    }
    for (std::size_t id = 0; id < points_.size(); ++id)
      ASSERT_EQ(hierarchy_.top_level(static_cast<std::int32_t>(id)) > 0, id < centers.size()) << id;
  }
  void move(std::size_t id, Vec3 to) { points_[id] = to; }
  void update() { hierarchy_.update(points_, box_); }
  bool is_put_off() const { return hierarchy_.repair_pending(); }

  /// That the list at the present positions is right, and the structure in order.
  void expect_right() {
    ListParams params;
    params.cutoffs = TypeCutoffs(kListRadius);
    NeighborList list;
    hierarchy_.list(params, list);
    EXPECT_EQ(first_difference(list, all_pairs(points_, box_, params)), "");
    EXPECT_EQ(hierarchy_.validate(), "");
  }

  /// The largest step along x of one point with which repair is put off, from an order that is made anew for
  /// each; less than `beyond`.
  double largest_step(std::size_t id, double beyond) {
    const std::vector<Vec3> before = points_;
    const auto is_certified = [&](double step) {
      hierarchy_.update(before, box_);
      hierarchy_.repair();
      points_ = before;
      points_[id].x += step;
      update();
      return is_put_off();
    };
    double certified = 0;
    EXPECT_TRUE(is_certified(0));
    EXPECT_FALSE(is_certified(beyond));
    for (;;) {
      const double middle = 0.5 * (certified + beyond);
      if (middle <= certified || middle >= beyond) break;
      (is_certified(middle) ? certified : beyond) = middle;
    }
    hierarchy_.update(before, box_);
    hierarchy_.repair();
    points_ = before;
    return certified;
  }

  HierarchyTestAccess::Impl& inside() { return HierarchyTestAccess::impl(hierarchy_); }

  ListedHierarchy hierarchy_{params_with(16)};
  std::vector<Vec3> points_;
  Box box_;
};

TEST_F(Certificate, ScenesHaveTheThresholdsThatTheyCountOn) {
  start({{0, 0, 0}, {3.9, 0, 0}}, {{1, 0, 0}, {2.9, 0, 0}});
  EXPECT_DOUBLE_EQ(hierarchy_.level(1).edge_threshold, 3.8);
  EXPECT_EQ(hierarchy_.level(1).edges, 0);
  EXPECT_EQ(hierarchy_.levels(), 2);
}

// The center is a point too. While its points stay, what it moves does not show in the extent.
TEST_F(Certificate, CountsTheMotionOfACenterWhosePointsStay) {
  start({{0, 0, 0}, {3.9, 0, 0}}, {{1, 0, 0}, {2.9, 0, 0}});
  move(0, {1.95, 0, 0});  // 0.95 from the point of its own that stays, and as far from that of the other one
  update();
  EXPECT_FALSE(is_put_off());
  expect_right();
}

TEST_F(Certificate, CountsTheExtentOfALeafWhoseCenterStays) {
  start({{0, 0, 0}, {3.9, 0, 0}}, {{1, 0, 0}, {2.9, 0, 0}});
  move(2, {1.95, 0, 0});
  update();
  EXPECT_FALSE(is_put_off());
  expect_right();
}

// Either alone would be within the limit.
TEST_F(Certificate, AddsExtentAndMotion) {
  start({{0, 0, 0}, {3.9, 0, 0}}, {{1, 0, 0}});
  move(0, {0.9, 0, 0});
  move(2, {2.2, 0, 0});
  move(1, {3.1, 0, 0});
  update();
  EXPECT_FALSE(is_put_off());
  expect_right();
}

TEST_F(Certificate, LooksAtEveryLeaf) {
  for (std::size_t mover = 0; mover < 4; ++mover) {
    start({{0, 0, 0}, {20, 0, 0}, {40, 0, 0}, {60, 0, 0}}, {});
    move(mover, points_[mover] + Vec3{0, 1.5, 0});
    update();
    EXPECT_FALSE(is_put_off()) << mover;
  }
}

TEST_F(Certificate, HoldsToTheLastDigitOfItsLimit) {
  start({{0, 0, 0}, {3.9, 0, 0}}, {});
  const double limit = 0.5 * (hierarchy_.level(1).edge_threshold - kListRadius) / kInflate;
  EXPECT_EQ(largest_step(0, 2), limit);
  move(0, {limit, 0, 0});
  move(1, {3.9 - limit, 0, 0});  // the worst that is certified: both approach as far as they may
  update();
  EXPECT_TRUE(is_put_off());
  expect_right();
}

// A pair that just fails to have an edge, and closes in by as much as is certified, stays out of reach.
TEST_F(Certificate, ItsLimitMissesNoPairHoweverNearTheThreshold) {
  const double apart = std::nextafter(params_with(16).radius + 2 + 0.8, 10);
  start({{0, 0, 0}, {apart, 0, 0}}, {});
  ASSERT_EQ(hierarchy_.level(1).edges, 0);
  const double limit = largest_step(0, 2);
  move(0, {limit, 0, 0});
  move(1, {apart - limit, 0, 0});
  update();
  EXPECT_TRUE(is_put_off());
  expect_right();
  move(1, {apart - limit - 1e-9, 0, 0});
  update();
  EXPECT_FALSE(is_put_off());
  expect_right();
}

// Displacements are from where the leaves were when the structure was in order, not from one update to the
// next.
TEST_F(Certificate, AddsUpOverUpdates) {
  start({{0, 0, 0}, {3.9, 0, 0}}, {});
  for (const double x : {1.0, 2.0, 3.0}) {
    move(0, {x, 0, 0});
    update();
    EXPECT_EQ(is_put_off(), x != 2.0) << "the repair at 2 starts anew";
    expect_right();
  }
}

TEST_F(Certificate, GoingBackUsesNothingUp) {
  start({{0, 0, 0}, {3.9, 0, 0}}, {});
  for (int step = 0; step < 6; ++step) {
    move(0, {step % 2 == 0 ? 1.0 : -1.0, 0, 0});
    update();
    EXPECT_TRUE(is_put_off()) << step;
    EXPECT_DOUBLE_EQ(inside().motion, 1.0);
  }
  move(0, {0, 0, 0});
  update();
  EXPECT_EQ(inside().motion, 0);
}

// Descents from other hierarchies allow for the largest motion of a node.
TEST_F(Certificate, KnowsTheLargestMotion) {
  for (const bool first_is_faster : {false, true}) {
    start({{0, 0, 0}, {20, 0, 0}}, {});
    move(0, {0, first_is_faster ? 0.5 : 0.25, 0});
    move(1, {20, first_is_faster ? 0.25 : 0.5, 0});
    update();
    ASSERT_TRUE(is_put_off());
    EXPECT_DOUBLE_EQ(inside().motion, 0.5);
  }
}

/// A point on its own at the origin, in the level with the given number: no node of that level is within its
/// threshold, but one is in the level above. And a leaf of two points.
class CertificateOfSingletons : public Certificate, public ::testing::WithParamInterface<int> {
 protected:
  void SetUp() override {
    const int level = GetParam();
    distance_ = std::ldexp(2.5, level);  // between rho_i = 2^(i + 1) - 0.2 and rho_(i + 1)
    hierarchy_ = ListedHierarchy(params_with(1));
    points_ = {{0, 0, 0}, {-distance_, 0, 0}, {-distance_, 0.5, 0}};
    build_and_fold();
    ASSERT_EQ(inside().singletons.size(), 1u);
    ASSERT_EQ(inside().singletons[0].level, level);
    ASSERT_EQ(hierarchy_.validate(), "");
  }
  /// A build folds those alone for which there were levels enough when they came.
  void build_and_fold() {
    hierarchy_.build(points_, box_);
    update();
    hierarchy_.repair();
  }
  double distance_ = 0;
};

TEST_P(CertificateOfSingletons, SeesOneFlyIntoALeaf) {
  move(0, {-distance_ + 0.9, 0, 0});
  update();
  EXPECT_FALSE(is_put_off());
  expect_right();
}

TEST_P(CertificateOfSingletons, HoldsToTheLastDigitOfItsLimit) {
  const auto& levels = inside().levels;
  const double of_a_leaf = 0.5 * (levels[1].threshold - kListRadius) / kInflate;
  const double further = 0.5 * (levels[static_cast<std::size_t>(GetParam())].radius - levels[1].radius);
  EXPECT_EQ(largest_step(0, 2 * distance_), of_a_leaf + further / kInflate);
}

TEST_P(CertificateOfSingletons, AddsUpOverUpdates) {
  const double limit = 1.4 + 0.5 * (std::ldexp(1.0, GetParam()) - 2);
  move(0, {-0.75 * limit, 0, 0});
  update();
  EXPECT_TRUE(is_put_off());
  expect_right();
  move(0, {-1.5 * limit, 0, 0});
  update();
  EXPECT_FALSE(is_put_off());
  expect_right();
}

TEST_P(CertificateOfSingletons, LooksAtEachOfThem) {
  points_.push_back({-2 * distance_, 0, 0});
  build_and_fold();
  ASSERT_EQ(inside().singletons.size(), 2u);
  for (const std::size_t mover : {0u, 3u}) {
    const Vec3 home = points_[mover];
    move(mover, {-distance_, -0.9, 0});
    update();
    EXPECT_FALSE(is_put_off()) << mover;
    expect_right();
    move(mover, home);
    build_and_fold();
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, CertificateOfSingletons, ::testing::Values(2, 3, 4, 7),
                         ::testing::PrintToStringParamName());

/// Of a cube of side 8, whose corner is the origin: a point `k` cells away rounds like one 8 k farther out.
TEST_F(Certificate, AsksForARepairWhenPointsLieSoFarOutThatTheSlackIsUsedUp) {
  const Box box = Box::orthorhombic({8, 8, 8});
  // The slack is twice the bound for a reach of 3 + 3 + 2 = 8, beside 24 for the cell: enough for 40.
  const auto update_with_one = [&](double cells) {
    start({{3, 3, 2}, {1, 1, 1}}, {}, 16, box);
    move(0, {3 + 8 * cells, 3, 2});
    update();
  };
  update_with_one(4);
  EXPECT_TRUE(is_put_off()) << "exactly the slack";
  expect_right();
  update_with_one(5);
  EXPECT_FALSE(is_put_off());
  expect_right();
  EXPECT_GE(inside().wrap_slack, 2 * 48 * std::numeric_limits<double>::epsilon());
  update_with_one(1e6);
  EXPECT_FALSE(is_put_off());
  expect_right();
}

// The slack for rounding is for rounding alone: motion may not use it up.
TEST_F(Certificate, MotionMayNotUseUpTheSlackForRounding) {
  start({{3, 3, 2}, {3 + 8e9, 6, 6}}, {}, 16, Box::orthorhombic({8, 8, 8}));
  ASSERT_GT(inside().wrap_slack, 1e-6);
  const double step = largest_step(0, 2);
  EXPECT_LT(step, 1.4);
  EXPECT_GT(step, 1.4 - 1e-9);
}

// Displacements in one box say nothing about distances in another.
TEST_F(Certificate, HoldsInOneBoxAlone) {
  const auto box_of = [](double height) { return Box::orthorhombic({20, 20, height}); };
  start({{5, 5, 1}, {5, 5, 17}}, {}, 16, box_of(20));  // 4 apart through the face
  ASSERT_EQ(hierarchy_.level(1).edges, 0);
  box_ = box_of(16.5);  // and 0.5 now
  update();
  EXPECT_FALSE(is_put_off());
  expect_right();
}

// A repair after a change of the box enumerates the edges of all levels, however little moved.
TEST_F(Certificate, EdgesOfNoLevelOutliveTheirBox) {
  const auto box_of = [](double height) { return Box::orthorhombic({400, 400, height}); };
  for (const double gap : {10.0, 20.0, 40.0, 80.0}) {  // beyond the edges of levels 2 to 5
    start({{5, 5, 1}, {5, 5, 401 - gap}}, {{5.5, 5, 1}, {5.5, 5, 401 - gap}}, 1, box_of(400));
    box_ = box_of(400 - 0.4 * gap);
    update();
    expect_right();
  }
}

TEST_F(Certificate, PositionsOfRemovedPointsDoNotMatter) {
  start({{3, 3, 2}, {6, 6, 6}, {1, 6, 6}}, {}, 16, Box::orthorhombic({8, 8, 8}));
  hierarchy_.remove(2);
  for (const double anything : {std::numeric_limits<double>::quiet_NaN(), 1e200, 1e12}) {
    move(2, {anything, 0, 0});
    EXPECT_NO_THROW(update());
    EXPECT_TRUE(is_put_off());
    EXPECT_EQ(hierarchy_.validate(), "");
  }
}

}  // namespace
}  // namespace dch
