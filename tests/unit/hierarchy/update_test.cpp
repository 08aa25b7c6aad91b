// SPDX-License-Identifier: MIT
//
// What update() does with removed and inserted points, points on their own and blocks, and many small scenes
// in which every level changes at every step. Small, so that each is checked after each step.
#include <gtest/gtest.h>
#include <ostream>

#include "exact_scene.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr MaintenancePolicy kPolicies[] = {MaintenancePolicy::automatic, MaintenancePolicy::always_repair,
                                           MaintenancePolicy::always_rebuild};

// A build would give every id a point.
TEST(Update, LeavesRemovedPointsOutWhateverItDoes) {
  for (const MaintenancePolicy policy : kPolicies) {
    ListedHierarchy h(params_of(EdgeRule::additive, 16, policy));
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
    ListedHierarchy h(params_of(EdgeRule::additive, 16, policy));
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
    ListedHierarchy h(params_of(EdgeRule::additive, 16, policy));
    const std::vector<Vec3> points = scenes::uniform(40, {5, 5, 5}, 1);
    for (const Vec3 p : points) h.insert(p);
    h.update(points, Box::none());
    EXPECT_EQ(h.stats().builds, 1);
    expect_right(h, points, Box::none());
  }
}

// Of two clusters and a point on its own, which is a root.
TEST(Singletons, AreFoldedUpToTheRootsAndCountInEveryLevelBelow) {
  for (const bool fold : {true, false}) {
    StructureParams params = params_of(EdgeRule::additive, 2);
    params.collapse_singletons = fold;
    ListedHierarchy h(params);
    const std::vector<Vec3> points{{0, 0, 0}, {100, 0, 0}, {101.5, 0, 0}};
    h.build(points, Box::none());
    for (int k = 0; k < 2; ++k)
      h.update(points, Box::none());  // the level is needed although two nodes are left below
    ASSERT_EQ(h.levels(), 3);
    EXPECT_EQ(HierarchyTestAccess::impl(h).singletons.size(), fold ? 1u : 0u);
    for (int i = 0; i < h.levels(); ++i) EXPECT_EQ(h.level(i).nodes, i < 2 ? 3 : 2) << i;
    expect_right(h, points, Box::none());
    h.insert({0, 0, 100});
    EXPECT_EQ(HierarchyTestAccess::impl(h).singletons.size(), fold ? 2u : 0u);
    EXPECT_EQ(h.validate(), "");
  }
}

// In whatever order they stand: its own node may be the first of two children.
TEST(Singletons, HaveNoOtherChild) {
  ListedHierarchy h(params_of(EdgeRule::additive, 1));
  const std::vector<Vec3> points{{0, 0, 0}, {60, 0, 0}, {1.5, 0, 0}};
  h.build({points.data(), 2}, Box::none());
  h.insert(points[2]);
  auto& inside = HierarchyTestAccess::impl(h);
  const std::int32_t own = inside.node_of(0, 1), parent = inside.node_of(0, 2);
  ASSERT_EQ(h.parent(2, 1), 0);
  inside.detach(1, own);
  inside.attach(1, own, parent);
  ASSERT_EQ(inside.levels[2].first_child[static_cast<std::size_t>(parent)], own);
  h.update(points, Box::none());
  expect_right(h, points, Box::none());
}

TEST(Insertion, TakesTheNearestOfTheCentersThatCover) {
  for (const double x : {0.6, 0.9}) {
    ListedHierarchy h(params_of(EdgeRule::additive, 16));
    h.build(std::vector<Vec3>{{0, 0, 0}, {1.5, 0, 0}}, Box::none());
    EXPECT_EQ(h.parent(h.insert({x, 0, 0}), 0), x < 0.75 ? 0 : 1) << x;
  }
}

TEST(Insertion, FillsABlockBeforeItTakesAnother) {
  ListedHierarchy h(params_of(EdgeRule::additive, 16));
  h.build(std::vector<Vec3>{{0, 0, 0}}, Box::none());
  for (int k = 1; k < 24; ++k) {
    h.insert({0.01 * k, 0, 0});
    EXPECT_EQ(HierarchyTestAccess::impl(h).points.leaf.size(), static_cast<std::size_t>(k / 8 + 1));
  }
  for (const std::int32_t id : {3, 7, 12}) h.remove(id);
  for (int k = 0; k < 3; ++k) h.insert({0.005, 0, 0});
  EXPECT_EQ(HierarchyTestAccess::impl(h).points.leaf.size(), 3u) << "gaps are filled";
  EXPECT_EQ(h.validate(), "");
}

struct SmallScene {
  std::string name;
  EdgeRule rule;
  int max_roots;
  double side;  ///< of the cube that 40 points are in
  bool periodic;
};

std::ostream& operator<<(std::ostream& out, const SmallScene& scene) { return out << scene.name; }

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
      ListedHierarchy h(params_of(GetParam().rule, GetParam().max_roots, policy));
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
  ListedHierarchy h(params_of(GetParam().rule, GetParam().max_roots));
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
