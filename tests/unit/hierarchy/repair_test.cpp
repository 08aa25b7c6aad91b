// SPDX-License-Identifier: MIT
//
// Repair, insertion and removal where they are decided by a margin: points on the very edge of a rule, edges
// of upper levels that are kept or found anew, and many small scenes in which every level changes at every
// step. Small, so that each is checked after each step.
#include <cmath>
#include <gtest/gtest.h>

#include <dch/all_pairs.hpp>
#include <dch/hierarchy.hpp>

#include "hierarchy_test_access.hpp"
#include "list_compare.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

/// R_0 = 1, rho_0 = 1.
HierarchyParams params_of(EdgeRule rule, int max_roots,
                          MaintenancePolicy policy = MaintenancePolicy::always_repair) {
  HierarchyParams params;
  params.radius = rule == EdgeRule::thesis ? 2.1 : 1;
  if (rule == EdgeRule::additive) params.base_radius = 1;
  params.max_roots = max_roots;
  params.policy = policy;
  return params;
}

void expect_right(Hierarchy& h, const std::vector<Vec3>& points, const Box& box) {
  ASSERT_EQ(h.validate(), "");
  ListParams params;
  params.cutoffs = TypeCutoffs(h.params().radius);
  NeighborList list;
  h.list(params, list);
  ASSERT_EQ(first_difference(list, all_pairs(points, box, params)), "");
}

TEST(Repair, APointAtTheCoveringRadiusKeepsItsParentAndOneBeyondLosesIt) {
  for (const double x : {1.0, std::nextafter(1.0, 2.0)}) {
    Hierarchy h(params_of(EdgeRule::additive, 16));
    std::vector<Vec3> points{{0, 0, 0}, {0.5, 0, 0}};
    h.build(points, Box::none());
    const std::int32_t center = h.top_level(0) == 1 ? 0 : 1;
    points = {{0, 0, 0}, {0, 0, 0}};
    points[static_cast<std::size_t>(1 - center)].x = x;
    h.update(points, Box::none());
    EXPECT_EQ(h.stats().reparented, x > 1) << x;
    EXPECT_EQ(h.level(1).nodes, x > 1 ? 2 : 1) << x;
    expect_right(h, points, Box::none());
  }
}

TEST(Repair, CentersAtTheSeparationAreMergedAndThoseBeyondStay) {
  for (const double x : {1.0, std::nextafter(1.0, 2.0)}) {
    Hierarchy h(params_of(EdgeRule::additive, 16));
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

// In a cluster that is looked at because another point left it.
TEST(Repair, OnlyThePointsBeyondTheCoveringRadiusAreOrphans) {
  Hierarchy h(params_of(EdgeRule::additive, 16));
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

/// Two nodes of level 2 and one of level 1 between them, R_1 = 2 from the first; and one far away, for the
/// levels above.
struct Pair {
  explicit Pair(double between_nodes) : h(params_of(EdgeRule::additive, 1)) {
    points = {{0, 0, 0}, {0, 60, 0}, {between_nodes, 0, 0}, {0, 0, 1.5}};
    h.build({points.data(), 2}, Box::none());
    for (std::size_t k = 2; k < points.size(); ++k) h.insert(points[k]);
  }
  void update() { h.update(points, Box::none()); }
  Hierarchy h;
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
      EXPECT_EQ(scene.h.top_level(0) >= 2 && scene.h.top_level(2) >= 2, x > 2) << x << " from " << from;
      expect_right(scene.h, scene.points, Box::none());
    }
}

// It never had a node in level 1, and may get one that others have to give way to.
TEST(Repair, ALonePointMayFlyToAnyPlaceAmongClusters) {
  for (double x = -2; x < 20; x += 0.25) {
    Hierarchy h(params_of(EdgeRule::additive, 1));
    std::vector<Vec3> points;
    for (int k = 0; k < 12; ++k) points.push_back({1.5 * k, 0, 0});
    h.build(points, Box::none());
    points.push_back({0, 0, 300});
    h.insert(points.back());
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
    Hierarchy h(params_of(EdgeRule::additive, 1));
    std::vector<Vec3>
        points;  // two clusters beyond each other's edges at level 2, and more to have levels above
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
  Hierarchy h(params_of(EdgeRule::additive, 1));
  for (double side = 60; side > 10; side *= 0.98) {
    const Box box = Box::orthorhombic({side, 60, 60});
    const std::vector<Vec3> points{{1, 1, 1},          {1, 1.5, 1}, {side - 1, 1, 1},
                                   {side - 1, 1.5, 1}, {4, 30, 30}, {4, 30.5, 30}};
    if (h.size() == 0) h.build(points, box);
    h.update(points, box);
    ASSERT_EQ(h.validate(), "") << side;
  }
}

constexpr MaintenancePolicy kPolicies[] = {MaintenancePolicy::automatic, MaintenancePolicy::always_repair,
                                           MaintenancePolicy::always_rebuild};

// A build would give every id a point.
TEST(Update, LeavesRemovedPointsOutWhateverItDoes) {
  for (const MaintenancePolicy policy : kPolicies) {
    Hierarchy h(params_of(EdgeRule::additive, 16, policy));
    h.build(scenes::uniform(300, {9, 9, 9}, 1), Box::none());
    h.remove(5);
    for (std::uint64_t k = 2; k < 8; ++k) {
      h.update(scenes::uniform(300, {9, 9, 9}, k), Box::none());
      ASSERT_EQ(h.size(), 299u);
      ASSERT_FALSE(h.contains(5));
      ASSERT_EQ(h.validate(), "");
    }
    EXPECT_EQ(h.stats().updates, 6);
  }
}

TEST(Update, LeavesRemovedPointsOutWhereAllWereInserted) {
  for (const MaintenancePolicy policy : kPolicies) {
    Hierarchy h(params_of(EdgeRule::additive, 16, policy));
    std::vector<Vec3> points = scenes::uniform(40, {5, 5, 5}, 1);
    for (const Vec3 p : points) h.insert(p);
    h.remove(5);
    h.update(points, Box::none());
    EXPECT_EQ(h.size(), 39u);
    EXPECT_FALSE(h.contains(5));
    EXPECT_EQ(h.validate(), "");
  }
}

// Their R_0 is that of no points at all.
TEST(Update, BuildsWhereAllWereInserted) {
  for (const MaintenancePolicy policy : kPolicies) {
    Hierarchy h(params_of(EdgeRule::additive, 16, policy));
    const std::vector<Vec3> points = scenes::uniform(40, {5, 5, 5}, 1);
    for (const Vec3 p : points) h.insert(p);
    h.update(points, Box::none());
    EXPECT_EQ(h.stats().builds, 1);
    expect_right(h, points, Box::none());
  }
}

TEST(Repair, KnowsHowFarNodesOfUpperLevelsMovedWithRoomForRounding) {
  Hierarchy h(params_of(EdgeRule::additive, 1));
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

struct SmallScene {
  std::string name;
  EdgeRule rule;
  int max_roots;
  double side;  ///< of the cube that 40 points are in
  bool periodic;
};

/// Some points of a scene in which levels come and go: pairs, coincident points, points on their own.
class RepairOfSmallScenes : public ::testing::TestWithParam<SmallScene> {
 protected:
  Box box() const {
    const double side = GetParam().side;
    return GetParam().periodic ? Box::orthorhombic({side, 1.1 * side, 0.9 * side}) : Box::none();
  }
  std::vector<Vec3> points(std::uint64_t seed) const {
    const double side = GetParam().side;
    std::vector<Vec3> points = scenes::uniform(25, {side, side, side}, seed);
    scenes::Random random(seed);
    for (std::size_t k = 0; k < 10; ++k) points.push_back(points[k] + random.in_ball(1.5));
    for (std::size_t k = 0; k < 5; ++k) points.push_back(points[0]);
    return points;
  }
};

TEST_P(RepairOfSmallScenes, ValidAfterMotionOfEverySize) {
  for (const MaintenancePolicy policy : {MaintenancePolicy::always_repair, MaintenancePolicy::automatic})
    for (const double step : {0.01, 0.1, 0.5, 2.0, 8.0}) {
      Hierarchy h(params_of(GetParam().rule, GetParam().max_roots, policy));
      std::vector<Vec3> at = points(1);
      scenes::Random random(2);
      h.build(at, box());
      expect_right(h, at, box());
      for (int k = 0; k < 25; ++k) {
        for (Vec3& p : at) p = p + random.in_cube(step);
        h.update(at, box());
        ASSERT_NO_FATAL_FAILURE(expect_right(h, at, box())) << "step " << k << " of " << step;
      }
      if (policy == MaintenancePolicy::always_repair) {
        EXPECT_EQ(h.stats().repairs, 25);
      }
    }
}

TEST_P(RepairOfSmallScenes, ValidWhilePointsComeAndGo) {
  Hierarchy h(params_of(GetParam().rule, GetParam().max_roots));
  scenes::Random random(3);
  h.build(points(4), box());
  const std::vector<Vec3> more = points(5);
  for (std::size_t k = 0; k < 120; ++k) {
    const auto id = static_cast<std::int32_t>(random.below(h.capacity()));
    if (random.uniform() < (k < 60 ? 0.3 : 0.7)) {
      if (h.contains(id)) h.remove(id);
    } else {
      h.insert(more[k % more.size()] + random.in_ball(0.5), h.contains(id) && k % 2 == 0 ? id : -1);
    }
    ASSERT_EQ(h.validate(), "") << k;
    if (k % 10 != 9) continue;
    std::vector<Vec3> at(h.capacity());
    for (std::size_t i = 0; i < at.size(); ++i)
      if (h.contains(static_cast<std::int32_t>(i)))
        at[i] = h.position(static_cast<std::int32_t>(i)) + random.in_cube(0.5);
    h.update(at, box());
    ASSERT_EQ(h.validate(), "") << "motion after " << k;
  }
  for (std::int32_t id = 0; id < static_cast<std::int32_t>(h.capacity()); ++id) {
    if (h.contains(id)) h.remove(id);
    ASSERT_EQ(h.validate(), "") << "without " << id;
  }
  EXPECT_EQ(h.levels(), 2);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RepairOfSmallScenes,
                         ::testing::Values(SmallScene{"dense", EdgeRule::additive, 1, 4, false},
                                           SmallScene{"wide", EdgeRule::additive, 1, 60, false},
                                           SmallScene{"wide_thesis", EdgeRule::thesis, 1, 60, false},
                                           SmallScene{"gas", EdgeRule::additive, 1, 1000, false},
                                           SmallScene{"few_roots", EdgeRule::additive, 4, 30, false},
                                           SmallScene{"periodic", EdgeRule::additive, 1, 12, true},
                                           SmallScene{"periodic_gas", EdgeRule::thesis, 2, 300, true}),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace dch
