// SPDX-License-Identifier: MIT
//
// How many distances the structure computes: what the theorems say of its cost, with constants a tenth to a
// quarter above what was counted. The counts are exact and the same everywhere, so a descent that keeps a
// node too many, or an update that looks at what cannot have changed, shows here although the lists stay
// right.
#include <cmath>
#include <gtest/gtest.h>

#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

StructureParams params_for_work(EdgeRule rule, MaintenancePolicy policy = MaintenancePolicy::always_repair) {
  StructureParams params;
  params.radius = 1;
  params.edge_rule = rule;
  params.policy = policy;
  params.max_roots = 1;
  if (rule == EdgeRule::additive) params.base_radius = 0.5;
  return params;
}

/// Uniform, with two points in the unit of volume: n and the width of the cube grow together.
std::vector<Vec3> uniform_of(std::size_t n, std::uint64_t seed = 1) {
  const double side = std::cbrt(0.5 * static_cast<double>(n));
  return scenes::uniform(n, {side, side, side}, seed);
}

/// Distances of what `work` does.
template <class Work>
double distances_of(ListedHierarchy& h, const Work& work) {
  const std::int64_t before = h.stats().distances;
  work();
  return static_cast<double>(h.stats().distances - before);
}

double distances_of_build(ListedHierarchy& h, const std::vector<Vec3>& points) {
  return distances_of(h, [&] { h.build(points, Box::none()); }) / static_cast<double>(points.size());
}

// Theorem 5.4.1: O(lg alpha) for a point. Eight times as many points at the same density are three levels
// more.
TEST(Work, BuildGrowsWithTheLevelsAlone) {
  for (const EdgeRule rule : {EdgeRule::additive, EdgeRule::thesis}) {
    ListedHierarchy few(params_for_work(rule)), many(params_for_work(rule));
    const double of_few = distances_of_build(few, uniform_of(1000));
    const double of_many = distances_of_build(many, uniform_of(8000));
    EXPECT_GE(many.levels(), few.levels());
    EXPECT_LE(of_few, 31 * few.levels());
    EXPECT_LE(of_many, 37 * many.levels());
  }
}

// Clusters down to a thousandth of the cell: the levels follow the aspect ratio, the work follows the levels.
TEST(Work, BuildOfClusters) {
  ListedHierarchy h(params_for_work(EdgeRule::additive));
  const Box box = Box::orthorhombic({200, 200, 200});
  const std::vector<Vec3> points = scenes::clustered(box, 3000, 3);
  const double work = distances_of(h, [&] { h.build(points, box); }) / 3000;
  EXPECT_LE(work, 12 * h.levels());
}

TEST(Work, InsertionGrowsWithTheLevelsAlone) {
  for (const std::size_t n : {1000u, 8000u}) {
    ListedHierarchy h(params_for_work(EdgeRule::additive));
    const std::vector<Vec3> points = uniform_of(n), more = uniform_of(n, 2);
    h.build(points, Box::none());
    const double from_the_roots = distances_of(h, [&] {
      for (std::size_t k = 0; k < 100; ++k) h.insert(more[k * n / 100]);
    });
    EXPECT_LE(from_the_roots / 100, 43 * h.levels()) << n;
    const double beside_a_friend = distances_of(h, [&] {
      for (std::size_t k = 0; k < 100; ++k)
        h.insert(points[k * n / 100] + Vec3{0.1, 0, 0}, static_cast<std::int32_t>(k * n / 100));
    });
    EXPECT_LE(beside_a_friend / 100, 52) << n << ", whatever the number of levels";
    const double removal = distances_of(h, [&] {
      for (std::size_t k = 0; k < 100; ++k) h.remove(static_cast<std::int32_t>(k * n / 100));
    });
    EXPECT_LE(removal / 100, 52 * h.levels()) << n;
  }
}

// A point ten thousand radii away is one distance a level from the others, whatever there is among them.
TEST(Work, InsertionFarAwayLooksAtNoLeaf) {
  ListedHierarchy h(params_for_work(EdgeRule::additive));
  h.build(uniform_of(8000), Box::none());
  h.insert({1e4, 0, 0});
  const double work = distances_of(h, [&] { h.insert({0, 1e4, 0}); });
  EXPECT_LE(work, h.levels());
  const double beside_it = distances_of(h, [&] { h.insert({0, 1e4, 1}); });
  EXPECT_LE(beside_it, h.levels() + 5);
}

TEST(Work, UpdateWithoutMotionLooksOnceAtEachPoint) {
  for (const std::size_t n : {1000u, 8000u}) {
    const std::vector<Vec3> points = uniform_of(n);
    ListedHierarchy certified(params_for_work(EdgeRule::additive, MaintenancePolicy::automatic));
    certified.build(points, Box::none());
    EXPECT_EQ(distances_of(certified, [&] { certified.update(points, Box::none()); }),
              static_cast<double>(n));
    ListedHierarchy repaired(params_for_work(EdgeRule::additive));
    repaired.build(points, Box::none());
    const double work = distances_of(repaired, [&] { repaired.update(points, Box::none()); });
    EXPECT_LE(work / static_cast<double>(n), 190) << n;
  }
}

// To the last distance: bounds have room for a search that keeps a few nodes too many. Whoever changes a
// search puts the new counts here and says why they are what they are.
TEST(Work, IsWhatItWas) {
  const Box box = Box::orthorhombic({200, 200, 200});
  std::vector<Vec3> points = scenes::clustered(box, 400, 3);
  for (const Vec3 p : scenes::uniform_in(box, 60, 4)) points.push_back(p);
  ListedHierarchy h(params_for_work(EdgeRule::additive, MaintenancePolicy::automatic));
  EXPECT_EQ(distances_of(h, [&] { h.build({points.data(), 440}, box); }), 27726);
  EXPECT_EQ(distances_of(h,
                         [&] {
                           for (std::size_t k = 440; k < 460; ++k) h.insert(points[k]);
                         }),
            4968);
  EXPECT_EQ(distances_of(h,
                         [&] {
                           for (std::int32_t id = 0; id < 460; id += 23)
                             h.insert(points[static_cast<std::size_t>(id)], id);
                         }),
            160);
  EXPECT_EQ(distances_of(h,
                         [&] {
                           for (std::int32_t id = 460; id < 480; ++id) h.remove(id);
                           for (std::int32_t id = 0; id < 460; id += 23) h.remove(id);
                         }),
            1579);
  std::vector<Vec3> moved(h.capacity());
  scenes::Random random(5);
  for (std::size_t id = 0; id < 460; ++id) moved[id] = points[id] + random.in_ball(0.05);
  h.update(moved, box);
  ASSERT_TRUE(h.repair_pending());
  EXPECT_EQ(distances_of(h, [&] { h.repair(); }), 13392);
}

// The edges of all levels are found anew in another box, and stand again after that.
TEST(Work, AChangedBoxCostsOneRepair) {
  const auto box_of = [](double side) { return Box::orthorhombic({side, side, side}); };
  const std::vector<Vec3> points = scenes::uniform(2000, {10, 10, 10}, 1);
  ListedHierarchy h(params_for_work(EdgeRule::additive));
  h.build(points, box_of(10));
  const double before = distances_of(h, [&] { h.update(points, box_of(10)); });
  const double changed = distances_of(h, [&] { h.update(points, box_of(10.0001)); });
  const double after = distances_of(h, [&] { h.update(points, box_of(10.0001)); });
  EXPECT_GT(changed, 1.2 * before);
  EXPECT_LT(after, 1.05 * before);
}

TEST(Work, LargeMotionCostsOneRepair) {
  std::vector<Vec3> points = uniform_of(2000);
  ListedHierarchy h(params_for_work(EdgeRule::additive));
  h.build(points, Box::none());
  const double before = distances_of(h, [&] { h.update(points, Box::none()); });
  for (Vec3& p : points) p.x += 3;
  const double moved = distances_of(h, [&] { h.update(points, Box::none()); });
  const double after = distances_of(h, [&] { h.update(points, Box::none()); });
  EXPECT_GT(moved, 1.2 * before);
  EXPECT_LT(after, 1.05 * before);
}

// Theorem of 5.5.3: O(n + k lg alpha) for k points that lost their parents.
TEST(Work, RepairGrowsWithThoseThatLostTheirParents) {
  const std::vector<Vec3> points = uniform_of(8000);
  const double n = static_cast<double>(points.size());
  for (const std::size_t lost : {0u, 10u, 100u, 1000u}) {
    ListedHierarchy h(params_for_work(EdgeRule::additive));
    h.build(points, Box::none());
    std::vector<Vec3> moved = points;
    scenes::Random random(4);
    for (std::size_t k = 0; k < lost; ++k) moved[8 * k] = points[8 * k] + random.in_ball(3);
    const double work = distances_of(h, [&] { h.update(moved, Box::none()); });
    const double edges =
        lost > 0 ? 80 * n : 0;  // of the upper levels, found anew once one of their nodes flew off
    EXPECT_LE(work, 190 * n + edges + 45.0 * static_cast<double>(h.stats().reparented) * h.levels()) << lost;
    EXPECT_GE(h.stats().reparented, static_cast<std::int64_t>(lost)) << lost;
  }
}

// From level 2 on edges are found anew only where motion may have made them incomplete.
TEST(Work, SmallMotionLeavesTheEdgesOfUpperLevelsAlone) {
  const std::vector<Vec3> points = uniform_of(8000);
  const auto distances_after = [&](double step) {
    ListedHierarchy h(params_for_work(EdgeRule::additive));
    h.build(points, Box::none());
    std::vector<Vec3> moved = points;
    scenes::Random random(5);
    for (Vec3& p : moved) p = p + random.in_ball(step);
    return distances_of(h, [&] { h.update(moved, Box::none()); }) / static_cast<double>(points.size());
  };
  EXPECT_LE(distances_after(1e-3), 190);
  EXPECT_LE(distances_after(1e-2), 192);
  EXPECT_GE(distances_after(1e-1), 250) << "this much is saved";
  EXPECT_LE(distances_after(1e-1), 340);
}

// Boxes and points that the search of cluster pairs looks at for each pair of clusters that it finds.
TEST(Work, OfClusterPairsGrowsWithTheirNumberAlone) {
  for (const std::size_t n : {4000u, 32000u}) {
    const double side = std::cbrt(0.1 * static_cast<double>(n));
    const Box box = Box::orthorhombic({side, side, side});
    StructureParams params;
    params.radius = 1;
    ListedHierarchy h(params);
    h.build(scenes::uniform_in(box, n, 4), box);
    ClusterPairs pairs;
    h.cluster_pairs(ListParams(), pairs);
    const auto work = h.pair_maker().work();
    const auto found = static_cast<double>(pairs.entries.size());
    const double of_nodes = static_cast<double>(work.beside_nodes) / found;
    const double of_clusters = static_cast<double>(work.beside_clusters) / found;
    const double of_points = static_cast<double>(work.by_points) / found;
    EXPECT_LE(of_nodes, 1.25) << n;
    EXPECT_LE(of_clusters, 9.5) << n;
    EXPECT_LE(of_points, 1.75) << n;
    EXPECT_EQ(work.by_slots, 0) << n;
  }
}

}  // namespace
}  // namespace dch
