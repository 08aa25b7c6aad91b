// SPDX-License-Identifier: MIT
//
// Neighbors at any radius in scenes in which everything is random, against all pairs: after motion, while a
// repair is put off, after insertions and removals.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/neighbors_within.hpp>

#include "effort.hpp"
#include "error_message.hpp"
#include "liquid.hpp"
#include "proximity_checks.hpp"
#include "proximity_scene.hpp"
#include "scenes.hpp"
#include "special_numbers.hpp"

namespace dch {
namespace {

std::vector<std::pair<double, std::int32_t>> all_within(const HierarchyView& view,
                                                        const std::vector<std::int32_t>& ids, Vec3 from,
                                                        std::int32_t self, double radius) {
  std::vector<std::pair<double, std::int32_t>> near;
  for (const std::int32_t id : ids) {
    const double distance2 = view.box().distance2(from, view.position(id));
    if (id != self && distance2 <= radius * radius) near.emplace_back(distance2, id);
  }
  std::sort(near.begin(), near.end());
  return near;
}

std::vector<std::pair<double, std::int32_t>> row_of(const NeighborsWithinRows& rows, std::size_t i) {
  std::vector<std::pair<double, std::int32_t>> row;
  for (std::int64_t k = rows.first[i]; k < rows.first[i + 1]; ++k)
    row.emplace_back(rows.distance2[static_cast<std::size_t>(k)], rows.id[static_cast<std::size_t>(k)]);
  return row;
}

TEST(NeighborsWithin, EqualAllPairsInRandomScenes) {
  for (int k = 0; k < effort(200); ++k) {
    ProximityScene scene(8000000 + static_cast<std::uint64_t>(k), 200);
    for (int step = 0; step < 4; ++step) {
      ASSERT_NO_FATAL_FAILURE(check_neighbors_within(scene)) << "step " << step;
      scene.change(step);
    }
  }
}

TEST(NeighborsWithin, AreAllPointsAtNoLimitInAnOpenBox) {
  Hierarchy hierarchy = liquid(4, Box::none());
  const NeighborsWithinRows rows =
      NeighborsWithin(hierarchy.view()).of_points(std::vector<std::int32_t>{5, 63}, kInfinity);
  EXPECT_EQ(rows.row(0).size(), 63u);
  EXPECT_EQ(rows.row(1).size(), 63u);
}

TEST(NeighborsWithin, CountThoseAtTheRadius) {
  HierarchyParams params;
  params.radius = 1;
  Hierarchy hierarchy(params);
  hierarchy.build(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}}, Box::none());
  const NeighborsWithin neighbors(hierarchy.view());
  const std::vector<std::int32_t> first{0};
  using Row = std::vector<std::pair<double, std::int32_t>>;
  EXPECT_EQ(row_of(neighbors.of_points(first, 1), 0), (Row{{0, 3}, {1, 1}}));
  EXPECT_EQ(row_of(neighbors.of_points(first, 0), 0), (Row{{0, 3}}));
}

TEST(NeighborsWithin, LookAtFewMorePointsThanTheyFind) {
  std::int64_t most_nodes = 200 * 120;  // as many more for eight times the points
  for (const int side : {12, 24, 48}) {
    Hierarchy hierarchy = liquid(side, Box::none());
    const std::vector<Vec3> positions = scenes::uniform(200, {1.0 * side, 1.0 * side, 1.0 * side}, 2);
    const NeighborsWithinRows rows = NeighborsWithin(hierarchy.view()).of_positions(positions, 1.5);
    EXPECT_LE(rows.work.points, 200 * 100);
    EXPECT_LE(rows.work.blocks, 200 * 100);
    EXPECT_LE(rows.work.nodes, most_nodes);
    most_nodes = rows.work.nodes + 200 * 160;
  }
}

TEST(NeighborsWithin, BadInputIsNamed) {
  Hierarchy hierarchy = liquid(4, Box::orthorhombic({4, 4, 4}));
  const NeighborsWithin neighbors(hierarchy.view());
  const std::vector<std::int32_t> ids{0}, none{64};
  const auto message = [&](double radius) {
    return test::message_of<InvalidParameter>([&] { neighbors.of_points(ids, radius); });
  };
  EXPECT_THAT(message(-1), testing::HasSubstr("radius of a neighbor query is -1; it must be 0 or more"));
  EXPECT_THAT(message(std::nan("")), testing::HasSubstr("query is nan"));
  EXPECT_THAT(test::message_of<CutoffTooLarge>([&] { neighbors.of_positions({}, 2.1); }),
              testing::HasSubstr("query is 2.1, above 2, half the smallest height"));
  EXPECT_THAT(test::message_of<InvalidParameter>([&] { neighbors.of_points(none, 1); }),
              testing::HasSubstr("neighbors of point 64 were asked for, and there is no point with that id"));
  EXPECT_THROW(neighbors.of_points(std::vector<std::int32_t>{-1}, 1), InvalidParameter);
  EXPECT_THROW(neighbors.of_positions(std::vector<Vec3>{{0, kInfinity, 0}}, 1), InvalidPosition);
  EXPECT_EQ(neighbors.of_points({}, 1).size(), 0u);
}

}  // namespace

void check_neighbors_within(ProximityScene& scene) {
  const std::vector<std::int32_t> ids = scene.ids();
  const HierarchyView view = scene.view();
  const NeighborsWithin neighbors(view);
  const double widest = std::min(10.0, scene.box().max_cutoff());
  const double radius =
      scene.random.below(5) == 0 ? widest : widest * std::pow(10, scene.random.uniform(-3, 0));
  const std::string what = scene.what() + ", radius " + std::to_string(radius);
  const NeighborsWithinRows of_points = neighbors.of_points(ids, radius);
  ASSERT_EQ(of_points.size(), ids.size()) << what;
  for (std::size_t p = 0; p < ids.size(); ++p)
    ASSERT_EQ(row_of(of_points, p), all_within(view, ids, view.position(ids[p]), ids[p], radius)) << what;
  std::vector<Vec3> positions;
  for (int q = 0; q < 10; ++q) positions.push_back(scene.somewhere());
  const NeighborsWithinRows of_positions = neighbors.of_positions(positions, radius);
  for (std::size_t q = 0; q < positions.size(); ++q)
    ASSERT_EQ(row_of(of_positions, q), all_within(view, ids, positions[q], -1, radius)) << what;
}

}  // namespace dch
