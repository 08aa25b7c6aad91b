// SPDX-License-Identifier: MIT
//
// Spanners in scenes in which everything is random, against all pairs: after motion, while a repair is put
// off, after insertions and removals.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/point_tree.hpp>
#include <dch/proximity/spanner.hpp>

#include "effort.hpp"
#include "error_message.hpp"
#include "liquid.hpp"
#include "proximity_checks.hpp"
#include "proximity_scene.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

/// All distances along edges, by Floyd and Warshall, by places in `ids`.
std::vector<double> all_paths(const Spanner& spanner, const std::vector<std::int32_t>& ids) {
  const std::size_t n = ids.size();
  std::vector<double> length(n * n, std::numeric_limits<double>::infinity());
  const auto place = [&](std::int32_t id) {
    return static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
  };
  for (std::size_t p = 0; p < n; ++p) length[p * n + p] = 0;
  for (const TreeEdge& edge : spanner.edges())
    length[place(edge.a) * n + place(edge.b)] = length[place(edge.b) * n + place(edge.a)] =
        std::sqrt(edge.distance2);
  for (std::size_t m = 0; m < n; ++m)
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = 0; q < n; ++q)
        length[p * n + q] = std::min(length[p * n + q], length[p * n + m] + length[m * n + q]);
  return length;
}

void check_path(const Spanner& spanner, const PointTree& tree, const SpannerPath& path) {
  double length = 0;
  for (std::size_t k = 1; k < path.points.size(); ++k) {
    const Span<const std::int32_t> next = spanner.neighbors(path.points[k - 1]);
    ASSERT_NE(std::find(next.begin(), next.end(), path.points[k]), next.end());
    length += std::sqrt(tree.distance2(path.points[k - 1], path.points[k]));
  }
  ASSERT_NEAR(path.length, length, 1e-12 * length);
}

TEST(Spanners, HaveShortPathsBetweenAllPairsInRandomScenes) {
  for (int k = 0; k < effort(200); ++k) {
    ProximityScene scene(4000000 + static_cast<std::uint64_t>(k), 70);
    for (int step = 0; step < 4; ++step) {
      ASSERT_NO_FATAL_FAILURE(check_spanner(scene)) << "step " << step;
      scene.change(step);
    }
  }
}

TEST(Spanners, HaveFewEdgesInALiquid) {
  const Box box = Box::none();
  const PointTree tree(liquid(12, box).view());
  const Spanner half(tree, 0.5), one(tree, 1), four(tree, 4);
  const auto n = static_cast<std::int64_t>(tree.size());
  EXPECT_LE(static_cast<std::int64_t>(half.edges().size()), 405 * n);
  EXPECT_LE(static_cast<std::int64_t>(one.edges().size()), 231 * n);
  EXPECT_LE(static_cast<std::int64_t>(four.edges().size()), 92 * n);
  EXPECT_LE(four.max_degree(), 780);
  double weight = 0;
  for (const TreeEdge& edge : four.edges()) weight += std::sqrt(edge.distance2);
  EXPECT_EQ(four.weight(), weight);
}

TEST(Spanners, MeasureTheirStretch) {
  const PointTree tree(liquid(6, Box::orthorhombic({6, 6, 6})).view());
  const Spanner coarse(tree, 8), fine(tree, 0.2);
  EXPECT_GT(coarse.stretch(), fine.stretch());
  EXPECT_LE(coarse.stretch(), 9);
  EXPECT_LE(fine.stretch(), 1.2);
  EXPECT_GE(fine.stretch(), 1);
}

TEST(Spanners, OfCoincidentPointsAreTreesWithoutLength) {
  HierarchyParams params;
  params.radius = 1;
  Hierarchy hierarchy(params);
  hierarchy.build(scenes::coincident(Box::none(), 2000), Box::none());
  const PointTree tree(hierarchy.view());
  const Spanner spanner(tree, 0.1);
  EXPECT_EQ(spanner.edges().size(), 1999u);
  EXPECT_EQ(spanner.weight(), 0);
  EXPECT_EQ(spanner.shortest_path(7, 1234).length, 0);
}

TEST(Spanners, BadInputIsNamed) {
  const PointTree tree(liquid(2, Box::none()).view());
  const auto message = [&](double epsilon) {
    return test::message_of<InvalidParameter>([&] { Spanner(tree, epsilon); });
  };
  EXPECT_THAT(message(0), testing::HasSubstr("epsilon of a spanner is 0; it must be positive and finite"));
  EXPECT_THAT(message(-0.5), testing::HasSubstr("spanner is -0.5"));
  EXPECT_THAT(message(std::nan("")), testing::HasSubstr("spanner is nan"));
  EXPECT_THAT(message(std::numeric_limits<double>::infinity()), testing::HasSubstr("spanner is inf"));
  const Spanner spanner(tree, 1);
  EXPECT_THAT(test::message_of<InvalidParameter>([&] { spanner.shortest_path(8, 0); }),
              testing::HasSubstr("from or to 8, and there is no point with that id"));
  EXPECT_THROW(spanner.shortest_path(0, -1), InvalidParameter);
  EXPECT_THROW(spanner.path_lengths(8), InvalidParameter);
}

TEST(Spanners, OfNothingAndOfOnePointThereAreNoEdges) {
  HierarchyParams params;
  params.radius = 1;
  Hierarchy hierarchy(params);
  for (const std::size_t n : {0, 1}) {
    hierarchy.build(scenes::coincident(Box::none(), n), Box::none());
    const PointTree tree(hierarchy.view());
    const Spanner spanner(tree, 1);
    EXPECT_TRUE(spanner.edges().empty());
    EXPECT_EQ(spanner.max_degree(), 0);
    EXPECT_EQ(spanner.stretch(), 1);
    EXPECT_TRUE(spanner.neighbors(0).empty());
    for (const std::int32_t id : tree.ids())
      EXPECT_EQ(spanner.shortest_path(id, id).points, std::vector<std::int32_t>{0});
  }
}

}  // namespace

void check_spanner(ProximityScene& scene) { check_spanner(scene, PointTree(scene.view())); }

void check_spanner(ProximityScene& scene, const PointTree& tree) {
  const std::vector<std::int32_t> ids = scene.ids();
  const double epsilon = std::pow(10, scene.random.uniform(-1.5, 1.5));
  const Spanner spanner(tree, epsilon);
  const std::vector<double> expected = all_paths(spanner, ids);
  const std::string what = scene.what() + ", epsilon " + std::to_string(epsilon);
  const double slack = 4 * static_cast<double>(ids.size()) * tree.rounding();
  for (std::size_t p = 0; p < ids.size(); ++p) {
    const std::vector<double> lengths = spanner.path_lengths(ids[p]);
    for (std::size_t q = 0; q < ids.size(); ++q) {
      const double distance = std::sqrt(tree.distance2(ids[p], ids[q]));
      const double length = lengths[static_cast<std::size_t>(ids[q])];
      ASSERT_LE(length, (1 + epsilon) * distance * (1 + 1e-12) + slack) << what;
      ASSERT_NEAR(length, expected[p * ids.size() + q], 1e-12 * length) << what;
    }
  }
  if (ids.empty()) return;
  const std::int32_t from = ids[scene.random.below(ids.size())], to = ids.back();
  const SpannerPath path = spanner.shortest_path(from, to);
  ASSERT_EQ(path.points.front(), from) << what;
  ASSERT_EQ(path.points.back(), to) << what;
  ASSERT_EQ(path.length, spanner.path_lengths(from)[static_cast<std::size_t>(to)]) << what;
  ASSERT_NO_FATAL_FAILURE(check_path(spanner, tree, path)) << what;
}

}  // namespace dch
