// SPDX-License-Identifier: MIT
//
// Nearest points by a grid that is kept up, in scenes in which everything is random, against all pairs: after
// insertions, removals and motion, of overfull cells and in voids. And counts: what the grid looks at, and
// that it is given up where descents do better.
//
// More than 300 lines: all tests take the same oracle and scenes.
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/kept_nearest.hpp>

#include "effort.hpp"
#include "error_message.hpp"
#include "nearest_oracle.hpp"
#include "places.hpp"
#include "proximity_scene.hpp"
#include "scenes.hpp"
#include "special_numbers.hpp"

namespace dch {
namespace {

NearestParams draw_params(scenes::Random& random, Executor* executor) {
  NearestParams params;
  params.k = 1 + static_cast<std::int32_t>(random.below(random.below(3) == 0 ? 40 : 3));
  params.epsilon = random.below(3) == 0 ? random.uniform(0, 2) : 0;
  params.executor = executor;
  return params;
}

void check_positions(const HierarchyView& view, KeptNearest& kept, const std::vector<Vec3>& positions,
                     const NearestParams& params, const std::string& what) {
  const NearestRows rows = kept.of_positions(positions, params);
  for (std::size_t q = 0; q < positions.size(); ++q)
    ASSERT_NO_FATAL_FAILURE(
        check_row(rows, q, sorted_by_distance(view, positions[q], -1), params.epsilon, what));
}

/// Near points, where they stand, and anywhere.
std::vector<Vec3> draw_positions(ProximityScene& scene, const HierarchyView& view) {
  std::vector<Vec3> positions;
  for (int q = 0; q < 12; ++q) {
    const auto id = static_cast<std::int32_t>(scene.random.below(view.capacity() + 1));
    const double off = scene.radius() * static_cast<double>(scene.random.below(3)) / 2;
    positions.push_back(view.contains(id) ? view.position(id) + scene.random.in_cube(off)
                                          : scene.somewhere());
  }
  return positions;
}

/// One that compares all, and one that is told what has changed.
void check_scene(ProximityScene& scene, KeptNearest& told) {
  const auto threads = make_thread_pool(1 + static_cast<int>(scene.random.below(3)));
  KeptNearest kept;
  Places places;
  for (int step = 0; step < 6; ++step) {
    const HierarchyView view = scene.view();
    kept.update(view);
    told.update(view, places.changed(view));
    for (KeptNearest* each : {&kept, &told})
      ASSERT_NO_FATAL_FAILURE(check_positions(view, *each, draw_positions(scene, view),
                                              draw_params(scene.random, threads.get()), scene.what()));
    scene.change(step / 2 + 1);
  }
}

TEST(KeptNearest, EqualsAllPairsInRandomScenes) {
  std::int64_t by_grid[4] = {}, descents = 0;
  for (int k = 0; k < effort(120); ++k) {
    ProximityScene scene(7500000 + static_cast<std::uint64_t>(k), k % 3 == 0 ? 200 : 4000,
                         k % 3 == 0 ? 0 : 1500);
    KeptNearest told;
    ASSERT_NO_FATAL_FAILURE(check_scene(scene, told));
    by_grid[static_cast<int>(scene.box().kind())] += told.work().by_grid;
    descents += told.work().descents;
  }
  EXPECT_GE(by_grid[static_cast<int>(Box::Kind::none)], effort(24));
  EXPECT_GE(by_grid[static_cast<int>(Box::Kind::orthorhombic)], effort(120));
  EXPECT_EQ(by_grid[static_cast<int>(Box::Kind::triclinic)], 0);
  EXPECT_GE(descents, effort(120));
}

Hierarchy hierarchy_of(const std::vector<Vec3>& points, const Box& box, double radius = 1.5) {
  HierarchyParams params;
  params.radius = radius;
  Hierarchy hierarchy(params);
  hierarchy.build(points, box);
  return hierarchy;
}

/// Points on the sites of a lattice come and go, and positions on sites and between them have many points as
/// near; a few sites have so many points that their cells are overfull.
TEST(KeptNearest, HasTheSmallestIdsOfMany) {
  scenes::Random random(75);
  for (int scene = 0; scene < effort(24); ++scene) {
    const Box box = scene % 2 == 0 ? Box::none() : Box::orthorhombic({16, 16, 16});
    const auto site = [&] {
      if (random.below(4) == 0) return Vec3{static_cast<double>(random.below(3)), 5, 15};
      return Vec3{static_cast<double>(random.below(16)), static_cast<double>(random.below(16)),
                  static_cast<double>(random.below(16))};
    };
    std::vector<Vec3> points;
    for (int p = 0; p < 2000; ++p) points.push_back(site());
    Hierarchy hierarchy = hierarchy_of(points, box);
    KeptNearest kept;
    kept.update(hierarchy.kept_view());
    for (int step = 0; step < 40; ++step) {
      std::vector<std::int32_t> changed{static_cast<std::int32_t>(random.below(hierarchy.capacity()))};
      if (hierarchy.contains(changed[0])) hierarchy.remove(changed[0]);
      for (std::uint64_t k = random.below(3); k > 0; --k) changed.push_back(hierarchy.insert(site()));
      const HierarchyView view = hierarchy.kept_view();
      kept.update(view, changed);
      const std::vector<Vec3> positions{site(), site() + Vec3{0.5, 0, 0}, site() + Vec3{0.5, 0.5, 0.5}};
      ASSERT_NO_FATAL_FAILURE(
          check_positions(view, kept, positions, {1 + step % 9},
                          "scene " + std::to_string(scene) + ", step " + std::to_string(step)));
    }
    EXPECT_GE(kept.work().by_grid, 30);
  }
}

/// Of points and positions that are given in any image.
TEST(KeptNearest, TakesPointsInAnyImage) {
  scenes::Random random(76);
  const Box box = Box::orthorhombic({20, 17, 19});
  std::vector<Vec3> points = scenes::uniform(4000, {20, 17, 19}, 77);
  for (Vec3& p : points)
    p = p +
        Vec3{20.0 * static_cast<double>(random.below(5)), -17.0 * static_cast<double>(random.below(3)), 0};
  Hierarchy hierarchy = hierarchy_of(points, box);
  KeptNearest kept;
  const HierarchyView view = hierarchy.kept_view();
  kept.update(view);
  std::vector<Vec3> positions;
  for (int k = 0; k < 300; ++k)
    positions.push_back({random.uniform(-40, 60), random.uniform(-1, 1), random.uniform(18, 20)});
  ASSERT_NO_FATAL_FAILURE(check_positions(view, kept, positions, {5}, "any image"));
  EXPECT_EQ(kept.work().descents, 0);
}

/// So little outside that no share of the period, as computed, is as little.
TEST(KeptNearest, FindsPointsThatAreHardlyOutsideThePeriodicBox) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  std::vector<Vec3> points = scenes::uniform(4000, {16, 16, 16}, 80);
  for (std::size_t k = 0; k < 40; ++k) points[100 * k] = {-kLeast, 0.4 * static_cast<double>(k), -kLeast};
  Hierarchy hierarchy = hierarchy_of(points, Box::orthorhombic({16, 16, 16}));
  KeptNearest kept;
  const HierarchyView view = hierarchy.kept_view();
  kept.update(view);
  std::vector<Vec3> positions;
  for (std::size_t k = 0; k < 40; ++k) positions.push_back(points[100 * k] + Vec3{0.001, 0.001, -0.001});
  ASSERT_NO_FATAL_FAILURE(check_positions(view, kept, positions, {3}, "hardly outside"));
  EXPECT_EQ(kept.work().descents, 0);
}

/// So near each other that their squared distances are 0, as computed: all are as near.
TEST(KeptNearest, HasTheSmallestIdsWhereSquaresOfDistancesAreTooSmallForDoubles) {
  std::vector<Vec3> points;
  for (int k = 0; k < 100; ++k) points.push_back({1e-170 * (37 * k % 100), 0, 0});
  Hierarchy hierarchy = hierarchy_of(points, Box::none());
  KeptNearest kept;
  const HierarchyView view = hierarchy.kept_view();
  kept.update(view);
  ASSERT_NO_FATAL_FAILURE(check_positions(view, kept, {points[50], points[70]}, {3}, "too near"));
}

/// Whatever ids are named: of another box, of fewer ids than before, and of another hierarchy.
TEST(KeptNearest, TakesAllPointsOfAnotherBoxOrHierarchy) {
  const Box box = Box::orthorhombic({16, 16, 16});
  const std::vector<Vec3> points = scenes::uniform(4000, {16, 16, 16}, 88);
  Hierarchy hierarchy = hierarchy_of(points, box);
  Hierarchy other = hierarchy_of(scenes::uniform(2000, {16, 16, 16}, 89), box);
  KeptNearest kept;
  kept.update(hierarchy.kept_view());
  const auto check = [&](const HierarchyView& view, const std::string& what) {
    kept.update(view, std::vector<std::int32_t>());
    check_positions(view, kept, scenes::uniform(1000, {16, 16, 0.1}, 90), {2}, what);
  };
  ASSERT_NO_FATAL_FAILURE(check(hierarchy.kept_view(), "as it was"));
  hierarchy.update(points, Box::orthorhombic({16, 16, 15.5}));
  ASSERT_NO_FATAL_FAILURE(check(hierarchy.kept_view(), "another box"));
  hierarchy.build(scenes::uniform(3000, {16, 16, 16}, 91), box);
  ASSERT_NO_FATAL_FAILURE(check(hierarchy.kept_view(), "another box, fewer points"));
  hierarchy.build(scenes::uniform(2000, {16, 16, 16}, 92), box);
  ASSERT_NO_FATAL_FAILURE(check(hierarchy.kept_view(), "fewer points"));
  ASSERT_NO_FATAL_FAILURE(check(other.kept_view(), "another hierarchy"));
  EXPECT_GE(kept.work().by_grid, 3500);
}

struct UniformPoints {
  explicit UniformPoints(std::size_t points)
      : side(std::cbrt(static_cast<double>(points))),
        hierarchy(hierarchy_of(scenes::uniform(points, {side, side, side}, 1), Box::none())) {}
  Vec3 somewhere() { return {random.uniform(0, side), random.uniform(0, side), random.uniform(0, side)}; }

  double side;
  Hierarchy hierarchy;
  scenes::Random random{78};
};

TEST(KeptNearest, LooksAtPointsOfNewIdsThatAreNotNamed) {
  UniformPoints scene(3000);
  KeptNearest kept;
  kept.update(scene.hierarchy.kept_view());
  for (int k = 0; k < 100; ++k) {
    const Vec3 at = scene.somewhere();
    const std::int32_t id = scene.hierarchy.insert(at);
    kept.update(scene.hierarchy.kept_view(), std::vector<std::int32_t>());
    EXPECT_EQ(kept.of_positions({&at, 1}, {}).id, (std::vector<std::int32_t>{id}));
  }
  EXPECT_GE(kept.work().by_grid, 90);
}

/// What a query looks at, in lines and points, in the mean, while every point goes and others come.
TEST(KeptNearest, LooksAtTheSameFewCellsHoweverManyPointsThereAre) {
  for (const std::size_t n : {20'000, effort(200'000)}) {
    UniformPoints scene(n);
    KeptNearest kept;
    kept.update(scene.hierarchy.kept_view());
    NearestRows row;
    NearestWork sum;
    for (std::size_t k = 0; k < n; ++k) {
      const auto id = static_cast<std::int32_t>(k);
      scene.hierarchy.remove(id);
      ASSERT_EQ(scene.hierarchy.insert(scene.somewhere()), id);
      kept.update(scene.hierarchy.kept_view(), {&id, 1});
      const Vec3 at = scene.somewhere();
      kept.of_positions({&at, 1}, {}, row);
      sum.blocks += row.work.blocks;
      sum.points += row.work.points;
    }
    EXPECT_LE(sum.blocks, 13 * static_cast<std::int64_t>(n));
    EXPECT_LE(sum.points, 2 * static_cast<std::int64_t>(n));
    EXPECT_LE(kept.work().descents, static_cast<std::int64_t>(n / 500));
    EXPECT_EQ(kept.work().grids, 1);
  }
}

std::int64_t total(const NearestWork& work) { return work.nodes + work.blocks + work.points; }

/// Positions that no grid has answers for: far from all points.
TEST(KeptNearest, GivesUpAGridThatDoesNotPay) {
  UniformPoints scene(3000);
  KeptNearest kept;
  kept.update(scene.hierarchy.kept_view());
  NearestRows row;
  std::int64_t with_grid = 0, alone = 0;
  for (int k = 0; k < 20'000; ++k) {
    const Vec3 at = scene.somewhere() + Vec3{5 * scene.side, 0, 0};
    kept.of_positions({&at, 1}, {}, row);
    with_grid += total(row.work);
    Nearest(scene.hierarchy.kept_view()).of_positions({&at, 1}, {}, row);
    alone += total(row.work);
  }
  EXPECT_EQ(kept.work().by_grid, 0);
  EXPECT_LE(kept.work().grids, 4);
  EXPECT_LE(with_grid, alone + alone / 10);
}

/// Points come and go without a question: the upkeep of a grid is for nothing.
TEST(KeptNearest, GivesUpAGridThatNobodyAsks) {
  UniformPoints scene(3000);
  KeptNearest kept;
  kept.update(scene.hierarchy.kept_view());
  for (int k = 0; k < 3000; ++k) {
    scene.hierarchy.remove(k);
    const std::int32_t id = scene.hierarchy.insert(scene.somewhere());
    kept.update(scene.hierarchy.kept_view(), {&id, 1});
  }
  const Vec3 at = scene.somewhere();
  kept.of_positions({&at, 1}, {});
  EXPECT_EQ(kept.work().descents, 1);
  for (int k = 0; k < 3000; ++k) kept.of_positions({&at, 1}, {});
  EXPECT_EQ(kept.work().grids, 2);
  EXPECT_GE(kept.work().by_grid, 1);
}

/// All on one spot but a few: one cell is overfull, and those of the others answer.
TEST(KeptNearest, AnswersBesideAnOverfullCell) {
  std::vector<Vec3> points = scenes::uniform(3000, {14, 14, 14}, 79);
  points.insert(points.end(), 500, Vec3{7, 7, 7});
  Hierarchy hierarchy = hierarchy_of(points, Box::none());
  KeptNearest kept;
  kept.update(hierarchy.kept_view());
  for (std::int32_t id = 3000; id < 3499; ++id) {
    hierarchy.remove(id);
    const HierarchyView view = hierarchy.kept_view();
    kept.update(view, {&id, 1});
    if (id % 10 == 0) {
      ASSERT_NO_FATAL_FAILURE(
          check_positions(view, kept, {{7, 7, 7.01}, {2, 2, 2}}, {2}, std::to_string(id)));
    }
  }
  EXPECT_GE(kept.work().by_grid, 49);
  EXPECT_GE(kept.work().descents, 45);
}

TEST(KeptNearest, OfFewPointsAndOfNoneAnswersToo) {
  Hierarchy hierarchy = hierarchy_of({}, Box::none());
  KeptNearest kept;
  kept.update(hierarchy.kept_view());
  const std::vector<Vec3> at{{1, 2, 3}};
  EXPECT_EQ(kept.of_positions(at, {2}).id, (std::vector<std::int32_t>{-1, -1}));
  for (std::int32_t id = 0; id < 200; ++id) {
    hierarchy.insert({1, 2, 4 + static_cast<double>(id)});
    kept.update(hierarchy.kept_view(), std::vector<std::int32_t>());
    EXPECT_EQ(kept.of_positions(at, {2}).id, (std::vector<std::int32_t>{0, id > 0 ? 1 : -1}));
  }
  EXPECT_GE(kept.work().by_grid, 10);
}

TEST(KeptNearest, BadInputIsNamed) {
  Hierarchy hierarchy = hierarchy_of({{0, 0, 0}, {1, 0, 0}}, Box::none());
  KeptNearest kept;
  const std::vector<Vec3> at{{0, 0, 0}};
  EXPECT_THAT(test::message_of<InvalidParameter>([&] { kept.of_positions(at, {}); }),
              testing::HasSubstr("call update() first"));
  kept.update(hierarchy.kept_view());
  EXPECT_THAT(test::message_of<InvalidParameter>([&] { kept.of_positions(at, {0}); }),
              testing::HasSubstr("0 nearest neighbors were asked for; ask for 1 to 1048576"));
  EXPECT_THROW(kept.of_positions(std::vector<Vec3>{{0, kInfinity, 0}}, {}), InvalidPosition);
  for (const std::int32_t id : {-1, 2})
    EXPECT_THAT(test::message_of<InvalidParameter>(
                    [&] { kept.update(hierarchy.kept_view(), std::vector<std::int32_t>{id}); }),
                testing::HasSubstr("point " + std::to_string(id) + " is said to have changed"));
  EXPECT_EQ(kept.of_positions(at, {}).id, (std::vector<std::int32_t>{0}));
}

}  // namespace
}  // namespace dch
