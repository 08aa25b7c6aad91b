// SPDX-License-Identifier: MIT
//
// Nearest neighbors in scenes in which everything is random, against all pairs: after motion, while a repair
// is put off, after insertions and removals, on any number of threads, with every instruction set.
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/nearest.hpp>

#include "effort.hpp"
#include "error_message.hpp"
#include "hierarchy/structure.hpp"
#include "instruction_sets.hpp"
#include "nearest_oracle.hpp"
#include "proximity_checks.hpp"
#include "proximity_scene.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

/// Queries of a scene as it is, with parameters drawn at random.
class NearestQueries {
 public:
  explicit NearestQueries(ProximityScene& scene) : scene_(scene) {
    threads_ = make_thread_pool(1 + static_cast<int>(scene_.random.below(3)));
  }

  void check_points(const HierarchyView& view) {
    const NearestParams params = ask();
    const NearestRows rows = Nearest(view).of_points(params);
    ASSERT_EQ(rows.size(), view.capacity());
    for (std::int32_t id = 0; id < static_cast<std::int32_t>(view.capacity()); ++id) {
      const auto expected =
          view.contains(id) ? sorted_by_distance(view, view.position(id), id) : std::vector<Neighbor>();
      ASSERT_NO_FATAL_FAILURE(check_row(rows, static_cast<std::size_t>(id), expected, 0, scene_.what()));
    }
  }
  void check_positions(const HierarchyView& view) {
    std::vector<Vec3> queries;
    for (int q = 0; q < 20; ++q)
      queries.push_back(scene_.somewhere() + scene_.random.in_cube(scene_.radius()));
    NearestParams params = ask();
    params.epsilon = scene_.random.below(2) == 0 ? 0 : scene_.random.uniform(0, 2);
    const NearestRows rows = Nearest(view).of_positions(queries, params);
    for (std::size_t q = 0; q < queries.size(); ++q)
      ASSERT_NO_FATAL_FAILURE(
          check_row(rows, q, sorted_by_distance(view, queries[q], -1), params.epsilon, scene_.what()));
  }

 private:
  NearestParams ask() {
    NearestParams params;
    params.k = 1 + static_cast<std::int32_t>(scene_.random.below(scene_.random.below(4) == 0 ? 300 : 14));
    params.executor = threads_.get();
    return params;
  }
  ProximityScene& scene_;
  std::unique_ptr<Executor> threads_;
};

TEST(Nearest, EqualsAllPairsInRandomScenes) {
  const RestoreInstructionSet restore;
  const auto sets = supported_sets();
  for (int k = 0; k < effort(160); ++k) {
    ProximityScene scene(2000000 + static_cast<std::uint64_t>(k), 260);
    NearestQueries queries(scene);
    set_instruction_set(sets[scene.random.below(sets.size())]);
    for (int step = 0; step < 4; ++step) {
      ASSERT_NO_FATAL_FAILURE(queries.check_points(scene.view()));
      ASSERT_NO_FATAL_FAILURE(queries.check_positions(scene.view()));
      scene.change(step);
    }
  }
}

/// The same while the hierarchy keeps up what queries need, with nothing but insertions and removals between.
void check_kept(ProximityScene& scene) {
  NearestQueries queries(scene);
  scene.kept_view();
  for (int step = 0; step < 12; ++step) {
    scene.exchange();
    if (step == 6) scene.measured_view();
    ASSERT_NO_FATAL_FAILURE(queries.check_positions(scene.kept_view()));
    if (step % 4 == 1) {
      ASSERT_NO_FATAL_FAILURE(queries.check_points(scene.kept_view()));
    }
  }
  scene.move();
  ASSERT_NO_FATAL_FAILURE(queries.check_positions(scene.kept_view()));
  scene.exchange();
  ASSERT_NO_FATAL_FAILURE(queries.check_positions(scene.kept_view()));
}

TEST(Nearest, EqualsAllPairsWhereAHierarchyKeepsUp) {
  for (int k = 0; k < effort(120); ++k) {
    ProximityScene scene(3000000 + static_cast<std::uint64_t>(k), 260);
    ASSERT_NO_FATAL_FAILURE(check_kept(scene));
  }
}

Hierarchy hierarchy_of(const std::vector<Vec3>& points, double radius) {
  HierarchyParams params;
  params.radius = radius;
  Hierarchy hierarchy(params);
  hierarchy.build(points, Box::none());
  return hierarchy;
}

/// What a query for the nearest point looks at, on average, in a cube of this side.
NearestWork work_a_query(const HierarchyView& view, double side) {
  const std::vector<Vec3> queries = scenes::uniform(500, {side, side, side}, 2);
  NearestWork work = Nearest(view).of_positions(queries, {}).work;
  for (std::int64_t* count : {&work.nodes, &work.blocks, &work.points}) *count /= 500;
  return work;
}
/// The same among n points of density 1.
NearestWork work_a_query(std::size_t n) {
  const double side = std::cbrt(static_cast<double>(n));
  return work_a_query(hierarchy_of(scenes::uniform(n, {side, side, side}, 1), 1.5).view(), side);
}

// While a repair is put off, points on their own are not where their nodes are.
TEST(Nearest, FindsPointsOnTheirOwnThatHaveMoved) {
  const double side = 1500;
  scenes::Random random(4);
  std::vector<Vec3> points = scenes::uniform(60, {side, side, side}, 5);
  HierarchyParams params;
  params.radius = 4;
  Hierarchy hierarchy(params);
  hierarchy.build(points, Box::none());
  for (int step = 0; step < 200; ++step) {
    for (Vec3& p : points) p = p + random.in_cube(2);
    hierarchy.update(points, Box::none());
    const HierarchyView view = hierarchy.view();
    const NearestRows rows = Nearest(view).of_points({1});
    for (std::int32_t id = 0; id < 60; ++id)
      ASSERT_EQ(rows.id[static_cast<std::size_t>(id)], sorted_by_distance(view, points[id], id)[0].id)
          << "step " << step;
  }
  EXPECT_GE(hierarchy.stats().refreshes, 50);
}

// Each level has eight times the nodes of the next and adds as many to a descent, whatever the number of
// points: ten times as many points add a constant.
TEST(Nearest, WorkOfAQueryGrowsAsTheLogarithmOfTheNumberOfPoints) {
  NearestWork before = work_a_query(1000);
  EXPECT_LE(before.nodes, 12);
  for (const std::size_t n : {10'000u, 100'000u, 1'000'000u}) {
    const NearestWork work = work_a_query(n);
    EXPECT_LE(work.nodes, before.nodes + 100) << n;
    EXPECT_LE(work.blocks, 120) << n;
    EXPECT_LE(work.points, 60) << n;
    before = work;
  }
}

// Every point goes and others come; what is kept up stays nearly as small as what is measured anew, and that
// is not done.
TEST(Nearest, WorkOfAQueryStaysWherePointsComeAndGo) {
  const std::size_t n = 50'000;
  const double side = std::cbrt(static_cast<double>(n));
  Hierarchy hierarchy = hierarchy_of(scenes::uniform(n, {side, side, side}, 1), 1.5);
  const NearestWork first = work_a_query(hierarchy.kept_view(), side);
  for (const Vec3 p : scenes::uniform(n, {side, side, side}, 3)) {
    hierarchy.remove(static_cast<std::int32_t>(hierarchy.stats().removed));
    hierarchy.insert(p);
  }
  EXPECT_FALSE(hierarchy.kept_view().structure().measured);
  const NearestWork last = work_a_query(hierarchy.kept_view(), side);
  EXPECT_LE(last.nodes, first.nodes + first.nodes / 5);
  EXPECT_LE(last.blocks, 2 * first.blocks);
  EXPECT_LE(last.points, 9 * first.points);
}

TEST(Nearest, BadInputIsNamed) {
  Hierarchy hierarchy = hierarchy_of({{0, 0, 0}, {1, 0, 0}}, 1);
  const Nearest nearest(hierarchy.view());
  const auto of_points = [&](NearestParams params) {
    return test::message_of<InvalidParameter>([&] { nearest.of_points(params); });
  };
  EXPECT_THAT(of_points({0}), testing::HasSubstr("0 nearest neighbors were asked for; ask for 1 to 1048576"));
  EXPECT_THAT(of_points({kMaxNearest + 1}), testing::HasSubstr("1048577 nearest"));
  EXPECT_THAT(of_points({1, -0.5}), testing::HasSubstr("epsilon of a nearest neighbor query is -0.5"));
  EXPECT_THAT(of_points({1, std::nan("")}), testing::HasSubstr("epsilon of a nearest neighbor query is nan"));
  const std::vector<Vec3> bad{{0, 0, 0}, {0, kNowhere, 0}};
  EXPECT_THROW(nearest.of_positions(bad, {}), InvalidPosition);
}

TEST(Nearest, OfNothingIsNothing) {
  Hierarchy hierarchy = hierarchy_of({}, 1);
  EXPECT_EQ(Nearest(hierarchy.view()).of_points({3}).size(), 0u);
  const NearestRows rows = Nearest(hierarchy.view()).of_positions(std::vector<Vec3>{{1, 2, 3}}, {2});
  EXPECT_EQ(rows.id, (std::vector<std::int32_t>{-1, -1}));
}

}  // namespace

void check_nearest(ProximityScene& scene) {
  NearestQueries queries(scene);
  ASSERT_NO_FATAL_FAILURE(queries.check_points(scene.view()));
  ASSERT_NO_FATAL_FAILURE(queries.check_positions(scene.view()));
}

}  // namespace dch
