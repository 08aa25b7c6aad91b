// SPDX-License-Identifier: MIT
//
// The margins of repair to the last digit: which edges are kept, how far is looked for others, what is
// measured and named once.
#include <cmath>
#include <gtest/gtest.h>

#include "exact_scene.hpp"
#include "geometry/metric.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

// As the proof for a single level needs it: what was joined within `complete` still holds all that the level
// below asks for, if from that three times the motion is taken.
TEST(Repair, EdgesAreKeptToTheLastDigitOfTheirMargin) {
  ListedHierarchy h(params_of(EdgeRule::additive, 1));
  h.build(std::vector<Vec3>{{0, 0, 0}, {50, 0, 0}}, Box::none());
  auto& inside = HierarchyTestAccess::impl(h);
  auto& level = inside.levels[2];
  const double needed = level.threshold + 0.5 * kEdgeSlack * level.radius * kInflate;
  level.moved = 0;
  level.complete = needed;
  EXPECT_TRUE(inside.edges_are_complete(2));
  level.complete = std::nextafter(needed, 0);
  EXPECT_FALSE(inside.edges_are_complete(2));
  level.moved = 0.125;
  level.complete = needed + 0.376;
  EXPECT_TRUE(inside.edges_are_complete(2));
  level.complete = needed + 0.374;
  EXPECT_FALSE(inside.edges_are_complete(2));
}

// The edges of level 1 are those of G_c and no others. A point that is a trillion boxes away makes its
// threshold wider for as long as it is.
TEST(Repair, EdgesOfLevelOneAreFoundAnewWhenTheSlackForRoundingShrinks) {
  const Box box = Box::orthorhombic({20, 20, 20});
  std::vector<Vec3> points{{5, 5, 5}, {8.5, 5, 5}, {15 + std::ldexp(20.0, 39), 15, 15}};
  ListedHierarchy h(params_of(EdgeRule::additive, 16));
  h.build(points, box);
  ASSERT_EQ(h.level(1).edges, 1);
  points[2].x = 15;
  h.update(points, box);
  EXPECT_EQ(h.level(1).edges, 0);
  expect_right(h, points, box);
}

/// Directions in which the multiples of a vector are no farther apart than the numbers say, but the last one
/// is farther from the first, by a rounding.
template <class Near>
std::vector<Vec3> deceptive_directions(double far, const Near& are_near) {
  std::vector<Vec3> found;
  scenes::Random random(1);
  while (found.size() < 20) {
    const Vec3 p = random.in_ball(1);
    const Vec3 u = (1 / std::sqrt(norm2(p))) * p;
    if (norm2(far * u) > far * far && are_near(u)) found.push_back(u);
  }
  return found;
}

/// That all edges are there when the points have come in this order, and when they are found anew.
void expect_edges_of(const std::vector<Vec3>& points) {
  ListedHierarchy h(params_of(EdgeRule::additive, 1));
  h.build({points.data(), 1}, Box::none());
  for (std::size_t k = 1; k < points.size(); ++k) h.insert(points[k]);
  ASSERT_NO_FATAL_FAILURE(expect_right(h, points, Box::none()));
  h.update(points, Box::none());
  ASSERT_NO_FATAL_FAILURE(expect_right(h, points, Box::none()));
}

// R_1 = 2 and rho_1 = 3: a node, a child of it and a neighbor of that in a line.
TEST(Repair, RoundingHidesNoNeighborAsFarAsThereMayBe) {
  const auto are_near = [](Vec3 u) { return norm2(2 * u) <= 4 && norm2(5 * u - 2 * u) <= 9; };
  for (const Vec3 u : deceptive_directions(5, are_near)) {
    expect_edges_of({{0, 0, 0}, 2 * u, 5 * u});
    expect_edges_of({{0, 0, 0}, 5 * u, 2 * u});
  }
}

// And its parent in line with them.
TEST(Repair, RoundingHidesNoParentOfANeighborAsFarAsThereMayBe) {
  const auto are_near = [](Vec3 u) {
    return norm2(2 * u) <= 4 && norm2(5 * u - 2 * u) <= 9 && norm2(7 * u - 5 * u) <= 4;
  };
  for (const Vec3 u : deceptive_directions(7, are_near)) {
    expect_edges_of({{0, 0, 0}, 7 * u, 2 * u, 5 * u});
    expect_edges_of({{0, 0, 0}, 7 * u, 5 * u, 2 * u});
  }
}

// Counted, since no edge depends on what lies beyond.
TEST(Repair, LooksAtTheChildrenOfNeighborsUpToItsReachAndNoFarther) {
  const auto work_at = [](double x) {
    ListedHierarchy h(params_of(EdgeRule::additive, 1));
    const std::vector<Vec3> points{{0, 0, 0}, {x, 0, 0}};
    h.build(points, Box::none());
    const std::int64_t before = h.stats().distances;
    h.update(points, Box::none());
    return h.stats().distances - before;
  };
  const double reach = (3 + 2 * 2) * kInflate;  // rho_1 and twice R_1
  EXPECT_GT(work_at(reach), work_at(std::nextafter(reach, 8)));
  EXPECT_EQ(work_at(std::nextafter(reach, 6)), work_at(reach));
}

TEST(Repair, NodesThatAreTooCloseAreNamedOnceTheSmallerFirst) {
  const std::array<std::int32_t, 2> both{0, 1};
  ListedHierarchy h(params_of(EdgeRule::additive, 16));
  std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}, {6, 0, 0}};
  h.build({points.data(), 1}, Box::none());
  for (std::size_t k = 1; k < points.size(); ++k) h.insert(points[k]);
  auto& inside = HierarchyTestAccess::impl(h);
  inside.levels[1].position[1] = {0.5, 0, 0};
  detail::with_metric(Box::none(), [&](const auto& metric) { inside.find_too_close(metric, 1); });
  ASSERT_EQ(inside.too_close.size(), 1u) << "where edges stand";
  EXPECT_EQ(inside.too_close[0], both);
  points[1].x = 0.5;
  h.update(points, Box::none());
  ASSERT_EQ(inside.too_close.size(), 1u) << "where they are found anew";
  EXPECT_EQ(inside.too_close[0], both);
}

TEST(Repair, PointsAreMeasuredOnceHoweverManyListsThereAre) {
  ListedHierarchy h(params_of(EdgeRule::additive, 16, MaintenancePolicy::automatic));
  const std::vector<Vec3> points{{0, 0, 0}, {0.5, 0, 0}};
  h.build(points, Box::none());
  auto& inside = HierarchyTestAccess::impl(h);
  EXPECT_FALSE(inside.measured);
  expect_right(h, points, Box::none());
  EXPECT_TRUE(inside.measured) << "by the list";
  h.insert({1, 0, 0});
  EXPECT_FALSE(inside.measured);
  h.update(std::vector<Vec3>{{0, 0, 0}, {0.5, 0, 0}, {0.75, 0, 0}}, Box::none());
  ASSERT_TRUE(h.repair_pending());
  EXPECT_TRUE(inside.measured) << "while positions were taken";
}

// A point five cells of side 8 away uses up more than what is twice the slack for four
// (certificate_test.cpp), unless the repair in between has set it anew.
TEST(Repair, OneThatWasPutOffMakesRoomForPointsFartherOut) {
  const Box box = Box::orthorhombic({8, 8, 8});
  std::vector<Vec3> points{{3, 3, 2}, {1, 1, 1}};
  for (const bool repair : {false, true}) {
    ListedHierarchy h(params_of(EdgeRule::additive, 16, MaintenancePolicy::automatic));
    h.build(points, box);
    for (const double cells : {4.0, 5.0}) {
      points[0].x = 3 + 8 * cells;
      h.update(points, box);
      EXPECT_EQ(h.repair_pending(), cells == 4 || repair);
      if (repair) h.repair();
    }
    expect_right(h, points, box);
    points[0].x = 3;
  }
}

}  // namespace
}  // namespace dch
