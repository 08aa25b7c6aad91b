// SPDX-License-Identifier: MIT
//
// The choice between repair and build, by counted work: what is counted, and that it goes by nothing else
// (docs/decisions/0012-repair-or-rebuild-by-counted-work.md).
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "exact_scene.hpp"
#include "hierarchy/build/base_radius.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

ListedHierarchy of_insertions(const std::vector<Vec3>& points, int max_roots) {
  ListedHierarchy h(params_of(EdgeRule::additive, max_roots, MaintenancePolicy::automatic));
  h.build({points.data(), 1}, Box::none());
  for (std::size_t k = 1; k < points.size(); ++k) h.insert(points[k]);
  return h;
}

/// What the choice at an update with these positions goes by.
detail::MaintenanceWork work_of(ListedHierarchy& h, const std::vector<Vec3>& moved) {
  auto& inside = HierarchyTestAccess::impl(h);
  inside.ahead = {};
  h.update(moved, Box::none());
  EXPECT_FALSE(h.repair_pending());
  return inside.ahead;
}

void expect_work(const detail::MaintenanceWork& work, double edges, double orphans, double candidates) {
  EXPECT_EQ(work.edges, edges);
  EXPECT_DOUBLE_EQ(work.orphans, orphans);
  EXPECT_DOUBLE_EQ(work.candidates, candidates);
}

/// A leaf of three points, one at the covering radius of its level, and one far away. Edges, in both
/// directions: 0 and 3 in level 1, 0 and 4 in levels 5 and 6.
const std::vector<Vec3> kLevels{{0, 0, 0}, {60, 0, 0}, {0, 0, 2}, {0.5, 0, 0}, {0, 0.5, 0}};

TEST(MaintenanceWorkTest, CountsPointsThatTheirCentersCoverNoMore) {
  std::vector<Vec3> points = kLevels;
  ListedHierarchy h = of_insertions(points, 1);
  ASSERT_EQ(h.levels(), 8);
  ASSERT_EQ(h.parent(2, 1), 0);
  points[3].x = 1.5;
  const auto work = work_of(h, points);
  EXPECT_EQ(work.points, 5);
  EXPECT_EQ(work.samples, 0);
  expect_work(work, 6, 1, 2);  // with one leaf beside its own
}

TEST(MaintenanceWorkTest, CountsNodesOfEachLevelThatTheirParentsCoverNoMore) {
  std::vector<Vec3> points = kLevels;
  ListedHierarchy h = of_insertions(points, 1);
  points[2].z = 4;
  expect_work(work_of(h, points), 6, 1, 1);
  h = of_insertions(kLevels, 1);
  ASSERT_EQ(h.top_level(1), 6);
  points[1].x = 64.5;  // from the root
  expect_work(work_of(h, points), 6, 2, 2);
}

// With the threshold as wide as that, a node of level 2 has a neighbor there.
TEST(MaintenanceWorkTest, CountsTheNeighborsOfTheParentsInTheirLevel) {
  std::vector<Vec3> points{{0, 0, 0}, {7, 0, 0}, {0, 2, 0}, {0, -2, 0}};
  ListedHierarchy h = of_insertions(points, 16);
  ASSERT_EQ(h.levels(), 2) << "roots are few enough";
  h = of_insertions(points, 2);
  ASSERT_EQ(h.levels(), 3);
  ASSERT_EQ(h.level(2).edges, 1);
  const double edges = 2.0 * static_cast<double>(h.level(1).edges + h.level(2).edges);
  points[2].y = 3.5;
  points[3].y = -3.5;
  expect_work(work_of(h, points), edges, 2, 2 * 2);
}

/// A chain of three leaves each of which is too close to the next one when the outer two have come nearer
/// to that in the middle.
struct Chain {
  /// @param order of the three; 0 stays and 1 is between 0 and 2
  explicit Chain(const std::array<std::size_t, 3>& order) : h(of_insertions(before(order), 16)) {
    for (const double y : {0.1, 0.2}) points.push_back({3, y, 0});
    points.push_back({6, 0.1, 0});
    for (std::size_t k = 3; k < points.size(); ++k) h.insert(points[k]);
    for (Vec3& p : points) p.x *= 0.3;
  }
  std::vector<Vec3> before(const std::array<std::size_t, 3>& order) {
    points.resize(3);
    for (std::size_t k = 0; k < 3; ++k) points[order[k]].x = 3 * static_cast<double>(k);
    return points;
  }
  std::vector<Vec3> points;
  ListedHierarchy h;
};

// Once it is gone, the one in the middle is too close to none.
TEST(MaintenanceWorkTest, CountsTheChildrenOfCentersThatAreGivenUp) {
  for (const std::array<std::size_t, 3>& order :
       {std::array<std::size_t, 3>{0, 1, 2}, std::array<std::size_t, 3>{0, 2, 1}}) {
    Chain chain(order);
    ASSERT_EQ(chain.h.level(1).nodes, 3);
    ASSERT_EQ(chain.h.level(1).edges, 2);
    const double orphans = detail::kOrphansOfDemoted * 3;
    expect_work(work_of(chain.h, chain.points), 4, orphans, orphans * 3);
    expect_right(chain.h, chain.points, Box::none());
  }
}

TEST(MaintenanceWorkTest, CountsTheSamplesOfABaseRadiusThatIsFound) {
  StructureParams params;
  params.radius = 1;
  ListedHierarchy h(params);
  std::vector<Vec3> points = scenes::uniform(500, {8, 8, 8}, 1);
  h.build(points, Box::none());
  for (Vec3& p : points) p.x += 8;
  const auto work = work_of(h, points);
  EXPECT_EQ(work.points, 500);
  EXPECT_EQ(work.samples, static_cast<double>(detail::density_samples(500)));
  EXPECT_GT(work.samples, 0);
}

/// 20 leaves each of which an edge joins to all others, and 542 points in all, of which some lose their
/// centers. Where these are 479, both ways cost 137,277 by the weights of the decision record: 12.5 * 542 +
/// 15 * 380 + 38 * 479 + 5.3 * 20 * 479 + 103 * 542 for the repair and 130 * 542 + 46 * 380 + 103 * 479.
TEST(MaintenanceChoice, RepairsUpToEqualWorkAndBuildsBeyond) {
  StructureParams params = params_of(EdgeRule::additive, 20, MaintenancePolicy::automatic);
  params.radius = 100;
  for (const std::size_t lost : {400u, 478u, 479u, 480u, 500u}) {
    ListedHierarchy h(params);
    std::vector<Vec3> points;
    for (int k = 0; k < 542; ++k) points.push_back({3.0 * (k % 20), k < 20 ? 0 : 0.5, 0});
    h.build({points.data(), 20}, Box::none());
    for (std::size_t k = 20; k < points.size(); ++k) h.insert(points[k]);
    for (std::size_t k = 20; k < 20 + lost; ++k) points[k].y = 1.5;
    const auto work = work_of(h, points);
    expect_work(work, 380, static_cast<double>(lost), 20.0 * static_cast<double>(lost));
    EXPECT_EQ(h.stats().repairs, lost <= 479) << lost;
    EXPECT_EQ(h.stats().builds, lost <= 479 ? 1 : 2) << lost;
  }
}

/// That so many particles may be exchanged, and no more.
void expect_exchange_pays_up_to(ListedHierarchy& h, std::size_t particles) {
  EXPECT_TRUE(HierarchyTestAccess::impl(h).exchange_pays(particles));
  EXPECT_FALSE(HierarchyTestAccess::impl(h).exchange_pays(particles + 1));
}

// One of them costs 100 and 7.5 for its own leaf, to build 130 a point: 5590 for 52 and for 43.
TEST(MaintenanceChoice, ExchangesUpToEqualWork) {
  ListedHierarchy h = of_insertions(std::vector<Vec3>(43), 16);
  expect_exchange_pays_up_to(h, 52);
}

// Two leaves of 20 and 5 points that an edge joins and one of 10: 60 candidates for 35 points, so 112.857
// for one; 130 * 35 + 46 * 2 to build.
TEST(MaintenanceChoice, AnExchangeLooksAtTheLeavesBesideThatOfTheParticle) {
  std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}, {9, 0, 0}};
  for (const auto& [x, count] : {std::pair<double, int>{0, 19}, {3, 4}, {9, 9}})
    for (int k = 0; k < count; ++k) points.push_back({x, 0.5, 0});
  ListedHierarchy h = of_insertions(points, 16);
  ASSERT_EQ(h.level(1).edges, 1);
  expect_exchange_pays_up_to(h, 41);
}

// Its points are those of another one: 107.5 for one, 130 * 30 to build.
TEST(MaintenanceChoice, AnExchangeLooksAtNoLeafThatWasGivenUp) {
  std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}};
  for (int k = 2; k < 30; ++k) points.push_back({k < 20 ? 0.0 : 3.0, 0, 0.25});
  ListedHierarchy h(params_of(EdgeRule::additive, 16));
  h.build({points.data(), 2}, Box::none());
  for (std::size_t k = 2; k < points.size(); ++k) h.insert(points[k]);
  for (Vec3& p : points) p.x *= 0.25;
  h.update(points, Box::none());
  ASSERT_EQ(h.stats().demotions, 1);
  ASSERT_EQ(h.level(1).nodes, 1);
  expect_exchange_pays_up_to(h, 36);
}

/// The automatic policy decides by counts alone.
class AutomaticPolicyTest : public ::testing::Test {
 protected:
  AutomaticPolicyTest() : hierarchy_(defaults()), points_(scenes::uniform(20000, {24, 24, 24}, 6)) {
    hierarchy_.build(points_, Box::none());
  }
  static StructureParams defaults() {
    StructureParams params;
    params.radius = 1;
    return params;
  }
  ListedHierarchy hierarchy_;
  std::vector<Vec3> points_;
};

TEST_F(AutomaticPolicyTest, RepairsWhenFewLostTheirParents) {
  points_[7].x += 20;
  hierarchy_.update(points_, Box::none());
  EXPECT_EQ(hierarchy_.stats().repairs, 1);
  EXPECT_EQ(hierarchy_.stats().builds, 1);
}

TEST_F(AutomaticPolicyTest, RebuildsWhenMostLostTheirParents) {
  hierarchy_.update(scenes::uniform(20000, {24, 24, 24}, 7), Box::none());
  EXPECT_EQ(hierarchy_.stats().repairs, 0);
  EXPECT_EQ(hierarchy_.stats().builds, 2);
}

TEST_F(AutomaticPolicyTest, RepairsWherePointsHaveBeenRemovedWhichABuildWouldBringBack) {
  hierarchy_.remove(5);
  hierarchy_.update(scenes::uniform(20000, {24, 24, 24}, 7), Box::none());
  EXPECT_EQ(hierarchy_.stats().builds, 1);
  EXPECT_EQ(hierarchy_.size(), 19999u);
  EXPECT_FALSE(hierarchy_.contains(5));
}

// All keep their parents, but half of the centers are demoted.
TEST_F(AutomaticPolicyTest, RebuildsWhenCentersCameTooCloseToEachOther) {
  for (Vec3& p : points_) p = 0.5 * p;
  hierarchy_.update(points_, Box::none());
  EXPECT_EQ(hierarchy_.stats().repairs, 0);
  EXPECT_EQ(hierarchy_.stats().builds, 2);
}

TEST(MaintenanceCostTest, ComparesWhatIsCounted) {
  detail::MaintenanceWork work;
  work.points = 1000;
  for (const auto& weights : {detail::kWeightsInBricks, detail::kWeightsInLattices}) {
    work.orphans = 10;
    work.candidates = 500;
    EXPECT_LT(repair_cost(work, weights), build_cost(work, weights));
    work.orphans = 1000;
    work.candidates = 50000;
    EXPECT_GT(repair_cost(work, weights), build_cost(work, weights));
  }
  EXPECT_EQ(&detail::weights_in(Box::none()), &detail::kWeightsInBricks);
  EXPECT_EQ(&detail::weights_in(Box::orthorhombic({9, 9, 9})), &detail::kWeightsInBricks);
  EXPECT_EQ(&detail::weights_in(Box::triclinic({9, 0, 0}, {2, 9, 0}, {0, 0, 9})),
            &detail::kWeightsInLattices);
}

// Beyond a tenth of the points all are put in order again, however many more there are.
TEST(MaintenanceCostTest, ReordersOnce) {
  detail::MaintenanceWork work;
  const auto& weights = detail::kWeightsInBricks;
  work.points = 1000;
  const auto of_orphans = [&](double orphans) {
    work.orphans = orphans;
    return repair_cost(work, weights) - weights.repair.point * work.points - weights.repair.orphan * orphans;
  };
  EXPECT_DOUBLE_EQ(of_orphans(50), 0.5 * weights.repair.reordered_point * work.points);
  EXPECT_DOUBLE_EQ(of_orphans(100), weights.repair.reordered_point * work.points);
  EXPECT_DOUBLE_EQ(of_orphans(900), weights.repair.reordered_point * work.points);
}

}  // namespace
}  // namespace dch
