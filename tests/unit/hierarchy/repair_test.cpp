// SPDX-License-Identifier: MIT
//
// Repair where a margin decides: points on the very edge of a rule, and edges of upper levels that are kept
// or found anew.
#include <cmath>
#include <gtest/gtest.h>

#include "exact_scene.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

TEST(Repair, APointAtTheCoveringRadiusKeepsItsParentAndOneBeyondLosesIt) {
  for (const double x : {1.0, std::nextafter(1.0, 2.0)}) {
    ListedHierarchy h(params_of(EdgeRule::additive, 16));
    std::vector<Vec3> points{{0, 0, 0}, {0.5, 0, 0}};
    h.build(points, Box::none());
    const std::int32_t center = h.top_level(0) == 1 ? 0 : 1;
    points = {{0, 0, 0}, {0, 0, 0}};
    points[static_cast<std::size_t>(1 - center)].x = x;
    h.update(points, Box::none());
    EXPECT_EQ(h.stats().reparented, x > 1) << x;
    EXPECT_EQ(h.stats().promotions, x > 1) << x;
    EXPECT_EQ(h.level(1).nodes, x > 1 ? 2 : 1) << x;
    expect_right(h, points, Box::none());
  }
}

TEST(Repair, CentersAtTheSeparationAreMergedAndThoseBeyondStay) {
  for (const double x : {1.0, std::nextafter(1.0, 2.0)}) {
    ListedHierarchy h(params_of(EdgeRule::additive, 16));
    std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}, {3.5, 0, 0}, {-0.5, 0, 0}};
    h.build({points.data(), 2}, Box::none());
    for (std::size_t k = 2; k < 4; ++k) h.insert(points[k]);
    points[1].x = x;
    points[2].x = 1.5;
    h.update(points, Box::none());
    EXPECT_EQ(h.stats().demotions, x <= 1) << x;
    EXPECT_EQ(h.top_level(0), 1) << "of two alike the one with the smaller id stays";
    EXPECT_EQ(h.top_level(1), x > 1) << x;
    expect_right(h, points, Box::none());
  }
}

TEST(Repair, OfTwoCentersAlikeTheOneWithTheSmallerIdStaysWhereverItStands) {
  for (const bool swap : {false, true}) {
    ListedHierarchy h(params_of(EdgeRule::additive, 16));
    std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}};
    h.build(points, Box::none());
    if (swap) h.renumber(std::vector<std::int32_t>{1, 0});
    points = {{0, 0, 0}, {0.5, 0, 0}};
    h.update(points, Box::none());
    EXPECT_EQ(h.top_level(0), 1);
    EXPECT_EQ(h.top_level(1), 0);
  }
}

// In a leaf that is looked at because another point left it.
TEST(Repair, OnlyThePointsBeyondTheCoveringRadiusAreOrphans) {
  ListedHierarchy h(params_of(EdgeRule::additive, 16));
  std::vector<Vec3> points{{0, 0, 0}};
  h.build(points, Box::none());
  for (const Vec3 p : {Vec3{0.5, 0, 0}, Vec3{0, 0.5, 0}}) {
    points.push_back(p);
    h.insert(p);
  }
  points[1] = {1, 0, 0};
  points[2] = {0, 1.01, 0};
  h.update(points, Box::none());
  EXPECT_EQ(h.stats().reparented, 1);
  expect_right(h, points, Box::none());
}

// A leaf that is given up has handed its points on, which are looked at there.
TEST(Repair, OrphansOfAMergedLeafAreLookedAtOnce) {
  ListedHierarchy h(params_of(EdgeRule::additive, 16));
  std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}, {3.5, 0, 0}};
  h.build({points.data(), 2}, Box::none());
  h.insert(points[2]);
  points[1].x = 0.9;
  points[2].x = 3;
  h.update(points, Box::none());
  EXPECT_EQ(h.stats().demotions, 1);
  EXPECT_EQ(h.stats().reparented, 1);
  expect_right(h, points, Box::none());
}

// Once more than a tenth of them are misplaced.
TEST(Repair, NodesAreReorderedOnceManyAreMisplaced) {
  ListedHierarchy h(params_of(EdgeRule::additive, 16));
  std::vector<Vec3> points{{0, 0, 0}, {5, 0, 0}};
  h.build(points, Box::none());
  for (int k = 0; k < 8; ++k) {
    points.push_back({0.01 * k, 0.5, 0});
    h.insert(points.back());
  }
  const auto misplaced = [&] { return HierarchyTestAccess::impl(h).misplaced; };
  h.update(points, Box::none());
  EXPECT_EQ(misplaced(), 0);
  points[2].x += 5;
  h.update(points, Box::none());
  EXPECT_EQ(h.stats().reparented, 1);
  EXPECT_EQ(misplaced(), 1) << "a tenth and no more";
  h.update(points, Box::none());
  EXPECT_EQ(misplaced(), 1);
  points[3].x += 5;
  h.update(points, Box::none());
  EXPECT_EQ(h.stats().reparented, 2);
  EXPECT_EQ(misplaced(), 0);
  expect_right(h, points, Box::none());
}

/// Two nodes of level 2 and one of level 1 between them, R_1 = 2 from the first; and one far away, for the
/// levels above.
struct Pair {
  explicit Pair(double between_nodes) : h(params_of(EdgeRule::additive, 1)) {
    points = {{0, 0, 0}, {0, 60, 0}, {between_nodes, 0, 0}, {0, 0, 1.5}};
    h.build({points.data(), 2}, Box::none());
    for (std::size_t k = 2; k < points.size(); ++k) h.insert(points[k]);
  }
  void update() { h.update(points, Box::none()); }
  ListedHierarchy h;
  std::vector<Vec3> points;
};

TEST(Repair, ANodeAtTheCoveringRadiusOfItsLevelKeepsItsParentAndOneBeyondLosesIt) {
  for (const double z : {2.0, std::nextafter(2.0, 3.0)}) {
    Pair scene(3);
    ASSERT_EQ(scene.h.top_level(3), 1);
    ASSERT_EQ(scene.h.parent(3, 1), 0);
    scene.points[3].z = z;
    scene.update();
    EXPECT_EQ(scene.h.stats().reparented, z > 2) << z;
    EXPECT_EQ(scene.h.top_level(3), z > 2 ? 2 : 1) << z;
    expect_right(scene.h, scene.points, Box::none());
  }
}

// By a step so small that edges are kept, and by one after which they are found anew.
TEST(Repair, NodesAtTheSeparationOfTheirLevelAreMergedAndThoseBeyondStay) {
  for (const double from : {2.02, 3.9})
    for (const double x : {2.0, std::nextafter(2.0, 3.0)}) {
      Pair scene(from);
      ASSERT_GE(scene.h.top_level(2), 2);
      scene.points[2].x = x;
      scene.update();
      EXPECT_EQ(scene.h.stats().reparented, 0) << "the other one's children are handed over";
      EXPECT_EQ(scene.h.top_level(0) >= 2 && scene.h.top_level(2) >= 2, x > 2) << x << " from " << from;
      expect_right(scene.h, scene.points, Box::none());
    }
}

// It never had a node in level 1, and may get one that others have to give way to.
TEST(Repair, ASingletonMayFlyToAnyPlaceAmongLeaves) {
  for (double x = -2; x < 20; x += 0.25) {
    ListedHierarchy h(params_of(EdgeRule::additive, 1));
    std::vector<Vec3> points;
    for (int k = 0; k < 12; ++k) points.push_back({1.5 * k, 0, 0});
    h.build(points, Box::none());
    points.push_back({0, 0, 300});
    h.insert(points.back());
    ASSERT_EQ(h.validate(), "") << "a new root";
    points.back() = {x, 0.25, 0};
    h.update(points, Box::none());
    ASSERT_NO_FATAL_FAILURE(expect_right(h, points, Box::none())) << x;
    h.update(points, Box::none());
    ASSERT_NO_FATAL_FAILURE(expect_right(h, points, Box::none())) << x;
  }
}

// Nodes of level 2 approach each other in steps that alone would leave the edges as they are.
TEST(Repair, MotionOfUpperLevelsAddsUpUntilTheirEdgesAreFoundAnew) {
  for (const double step : {0.02, 0.05, 0.2}) {
    ListedHierarchy h(params_of(EdgeRule::additive, 1));
    std::vector<Vec3>
        points;  // two leaves beyond each other's edges at level 2, and more to have levels above
    for (const double x : {0.0, 9.0, 60.0})
      for (const double y : {0.0, 0.4}) points.push_back({x, y, 0});
    h.build(points, Box::none());
    for (int k = 0; points[2].x > points[0].x + 0.5 && k < 400; ++k) {
      for (const std::size_t i : {0u, 1u}) points[i].x += step;
      for (const std::size_t i : {2u, 3u}) points[i].x -= step;
      h.update(points, Box::none());
      ASSERT_EQ(h.validate(), "") << "step " << k << " of " << step;
    }
    expect_right(h, points, Box::none());
  }
}

// A box that shrinks brings nodes together that have not moved.
TEST(Repair, EdgesAreFoundAnewInAnotherBox) {
  ListedHierarchy h(params_of(EdgeRule::additive, 1));
  for (double side = 60; side > 10; side *= 0.98) {
    const Box box = Box::orthorhombic({side, 60, 60});
    const std::vector<Vec3> points{{1, 1, 1},          {1, 1.5, 1}, {side - 1, 1, 1},
                                   {side - 1, 1.5, 1}, {4, 30, 30}, {4, 30.5, 30}};
    if (h.size() == 0) h.build(points, box);
    h.update(points, box);
    ASSERT_EQ(h.validate(), "") << side;
  }
}

TEST(Repair, KnowsHowFarNodesOfUpperLevelsMovedWithRoomForRounding) {
  ListedHierarchy h(params_of(EdgeRule::additive, 1));
  std::vector<Vec3> points{{0, 0, 0}, {0.5, 0, 0}, {50, 0, 0}, {50.5, 0, 0}};
  h.build(points, Box::none());
  ASSERT_GT(h.levels(), 3);
  double sum = 0;
  for (const double step : {0.03, 0.01, 0.02}) {
    for (Vec3& p : points) p.y += p.x > 40 ? 0.5 * step : step;  // the farthest counts
    sum += step;
    h.update(points, Box::none());
    EXPECT_GE(HierarchyTestAccess::impl(h).levels[2].moved, sum * (1 + 0.9e-12));
    EXPECT_LE(HierarchyTestAccess::impl(h).levels[2].moved, sum * (1 + 1.1e-12));
  }
}

}  // namespace
}  // namespace dch
