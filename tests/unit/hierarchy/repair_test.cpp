// SPDX-License-Identifier: MIT
//
// Repair, insertion and removal where they are decided by a margin: points on the very edge of a rule, edges of upper
// levels that are kept or found anew, and many small scenes in which every level changes at every step. Small, so
// that each is checked after each step.
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
HierarchyParams params_of(EdgeRule rule, int max_roots, MaintenancePolicy policy = MaintenancePolicy::always_repair) {
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
    expect_right(h, points, Box::none());
  }
}

// Nodes of level 2 approach each other in steps that alone would leave the edges as they are.
TEST(Repair, MotionOfUpperLevelsAddsUpUntilTheirEdgesAreFoundAnew) {
  for (const double step : {0.02, 0.05, 0.2}) {
    Hierarchy h(params_of(EdgeRule::additive, 1));
    std::vector<Vec3> points;  // two clusters beyond each other's edges at level 2, and more to have levels above
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
    const std::vector<Vec3> points{{1, 1, 1}, {1, 1.5, 1}, {side - 1, 1, 1}, {side - 1, 1.5, 1}, {4, 30, 30}, {4, 30.5, 30}};
    if (h.size() == 0) h.build(points, box);
    h.update(points, box);
    ASSERT_EQ(h.validate(), "") << side;
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

INSTANTIATE_TEST_SUITE_P(
    Scenes, RepairOfSmallScenes,
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
