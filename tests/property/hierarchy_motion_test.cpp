// SPDX-License-Identifier: MIT
//
// Black-box maintenance: whatever the points do between two updates, every invariant holds afterwards and the
// lists equal the oracle's.
#include <gtest/gtest.h>
#include <thread>

#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "effort.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"
#include "shake.hpp"

namespace dch {
namespace {

class HierarchyMotion : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(HierarchyMotion, ValidAfterEveryRepair) {
  const Box box = GetParam().box;
  for (const double factor : {0.01, 0.1, 0.5, 1.0, 3.0, 30.0}) {
    SCOPED_TRACE(factor);
    ASSERT_NO_FATAL_FAILURE(
        shake(scenes::uniform_in(box, 150, 31), box, repairing(), factor * r0(repairing()), 200, 77));
    for (const StructureParams& params : {repairing(EdgeRule::thesis, 1), repairing(EdgeRule::thesis, 16),
                                          repairing(EdgeRule::additive, 1, 2.0)})
      ASSERT_NO_FATAL_FAILURE(
          shake(scenes::uniform_in(box, 150, 32), box, params, factor * r0(params), 30, 78));
  }
}

TEST_P(HierarchyMotion, DegenerateScenesStayValid) {
  const Box box = GetParam().box;
  for (const scenes::NamedPoints& scene : scenes::hard_point_sets(box, 120, r0(repairing()))) {
    SCOPED_TRACE(scene.name);
    for (const StructureParams& params : {repairing(EdgeRule::additive, 1), repairing(EdgeRule::additive, 16),
                                          repairing(EdgeRule::thesis, 1), repairing(EdgeRule::thesis, 16)})
      for (const double factor : {0.01, 1.0, 30.0})
        ASSERT_NO_FATAL_FAILURE(shake(scene.points, box, params, factor * r0(params), 12, 5));
  }
}

// Small steps, so that displacements add up over several updates between two repairs.
TEST_P(HierarchyMotion, ListsStayExactWhileRepairIsPutOff) {
  const Box box = GetParam().box;
  const int steps = effort(60);
  for (const double base_radius : {0.0, 0.4 * kRadius})
    for (const double step : {0.002, 0.02, 0.05}) {
      StructureParams params;
      params.radius = kRadius;
      params.base_radius = base_radius;
      ListedHierarchy hierarchy(params);
      std::vector<Vec3> points = scenes::uniform_in(box, 400, 9);
      hierarchy.build(points, box);
      scenes::Random random(10);
      for (int s = 0; s < steps; ++s) {
        for (Vec3& p : points) p = p + random.in_cube(step);
        hierarchy.update(points, box);
        ASSERT_EQ(hierarchy.validate(), "") << "step " << s << " of " << step << ", R_0 = " << base_radius;
        NeighborList list;
        hierarchy.list(whole_list(), list);
        ASSERT_EQ(first_difference(list, all_pairs(points, box, whole_list())), "")
            << "step " << s << " of " << step << ", R_0 = " << base_radius;
      }
      if (step == 0.002) {
        EXPECT_GT(hierarchy.stats().refreshes, 10);
      }
      EXPECT_EQ(hierarchy.stats().refreshes + hierarchy.stats().repairs + hierarchy.stats().builds,
                steps + 1);
      if (step == 0.05 && base_radius > 0) {
        EXPECT_LT(hierarchy.stats().refreshes, steps) << "no repair was ever due";
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Boxes, HierarchyMotion, ::testing::ValuesIn(scenes::all_boxes(5.0)),
                         [](const auto& p) { return p.param.name; });

TEST(HierarchyMotion, LargeSetsStayValid) {
  const Box box = Box::orthorhombic({17, 17, 17});
  for (const double factor : {0.05, 1.0})
    ASSERT_NO_FATAL_FAILURE(
        shake(scenes::uniform_in(box, 5000, 3), box, repairing(), factor * r0(repairing()), 10, 8));
}

// Erratum of 5.5.3: with the text's demotion radius an update without any motion would demote and promote
// again and again.
TEST(HierarchyMotion, NoMotionChangesNothing) {
  const Box box = Box::orthorhombic({6, 6, 6});
  for (const EdgeRule rule : {EdgeRule::additive, EdgeRule::thesis}) {
    const std::vector<Vec3> points = scenes::uniform_in(box, 1000, 1);
    ListedHierarchy hierarchy(repairing(rule));
    hierarchy.build(points, box);
    for (int pass = 0; pass < 5; ++pass) hierarchy.update(points, box);
    EXPECT_EQ(hierarchy.stats().promotions, 0);
    EXPECT_EQ(hierarchy.stats().demotions, 0);
    EXPECT_EQ(hierarchy.stats().reparented, 0);
  }
}

TEST(HierarchyMotion, BoxesMayChangeFromOneUpdateToTheNext) {
  scenes::Random random(4);
  std::vector<Vec3> points = scenes::uniform(300, {6, 6, 6}, 2);
  ListedHierarchy hierarchy(repairing());
  hierarchy.build(points, Box::none());
  for (int step = 0; step < 60; ++step) {
    const double a = 5 + random.uniform(), b = 5 + random.uniform(), tilt = 4 * random.uniform() - 2;
    const Box box = step % 3 == 0   ? Box::orthorhombic({a, b, 6})
                    : step % 3 == 1 ? Box::triclinic({a, 0, 0}, {tilt, b, 0}, {-tilt, tilt, 6})
                                    : Box::orthorhombic({a, b, 6}, {true, false, true});
    hierarchy.update(points, box);
    ASSERT_EQ(hierarchy.validate(), "") << "step " << step;
    NeighborList list;
    hierarchy.list(whole_list(), list);
    ASSERT_EQ(first_difference(list, all_pairs(points, box, whole_list())), "") << "step " << step;
  }
}

TEST(HierarchyMotion, TheHistoryOfTheStructureDoesNotShowInTheList) {
  const Box box = Box::orthorhombic({6, 6, 6});
  std::vector<Vec3> points = scenes::uniform_in(box, 500, 2);
  scenes::Random random(12);
  ListedHierarchy repaired(repairing());
  repaired.build(points, box);
  for (int step = 0; step < 20; ++step) {
    for (Vec3& p : points) p = p + random.in_cube(0.2);
    repaired.update(points, box);
  }
  ListedHierarchy fresh(repairing());
  fresh.build(points, box);
  NeighborList a, b;
  repaired.list(whole_list(), a);
  fresh.list(whole_list(), b);
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.j, b.j);
}

// Distinct objects share nothing; the thread sanitizer looks on.
TEST(HierarchyMotion, ObjectsInDifferentThreadsDoNotDisturbEachOther) {
  const Box box = Box::orthorhombic({6, 6, 6});
  std::vector<std::thread> threads;
  std::vector<std::vector<std::int32_t>> results(4);
  for (std::size_t t = 0; t < results.size(); ++t) {
    threads.emplace_back([&, t] {
      std::vector<Vec3> points = scenes::uniform_in(box, 400, 2);
      scenes::Random random(1);
      const auto search = make_dch_search(repairing());
      NeighborList list;
      for (int step = 0; step < 5; ++step) {
        for (Vec3& p : points) p = p + random.in_cube(0.1);
        search->update(points, box);
        search->list(whole_list(), list);
      }
      results[t] = list.j;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, results[0]);
  EXPECT_FALSE(results[0].empty());
}

}  // namespace
}  // namespace dch
