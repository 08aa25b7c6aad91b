// SPDX-License-Identifier: MIT
//
// The nearest others of all points at once, against all pairs, where density varies within a leaf, where many
// points are as near as each other, with lengths at the ends of what float holds, and for as many neighbors
// as take all the ways to put what was found in order: with every instruction set.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/instruction_set.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/nearest.hpp>

#include "instruction_sets.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kNoDistance = std::numeric_limits<double>::infinity();
const Vec3 kDensest{5, 5, 5};

using SortedRow = std::vector<std::pair<double, std::int32_t>>;  // squared distances and ids

/// The oracle: by id, all other points, the nearest first, of equally near ones that with the smaller id.
std::vector<SortedRow> all_pairs_sorted(const std::vector<Vec3>& points, const Box& box) {
  std::vector<SortedRow> rows(points.size());
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = 0; b < points.size(); ++b)
      if (a != b) rows[a].emplace_back(box.distance2(points[a], points[b]), static_cast<std::int32_t>(b));
    std::sort(rows[a].begin(), rows[a].end());
  }
  return rows;
}

void expect_rows(const NearestRows& rows, const std::vector<SortedRow>& expected, const std::string& where) {
  const auto k = static_cast<std::size_t>(rows.k);
  ASSERT_EQ(rows.size(), expected.size()) << where;
  for (std::size_t a = 0; a < expected.size(); ++a) {
    for (std::size_t j = 0; j < k; ++j) {
      const auto [distance2, id] =
          j < expected[a].size() ? expected[a][j] : std::pair<double, std::int32_t>(kNoDistance, -1);
      ASSERT_EQ(rows.id[a * k + j], id) << where << ", row " << a << ", neighbor " << j;
      ASSERT_EQ(rows.distance2[a * k + j], distance2) << where << ", row " << a << ", neighbor " << j;
    }
  }
}

Hierarchy hierarchy_in(const std::vector<Vec3>& points, const Box& box, double radius) {
  HierarchyParams params;
  params.radius = radius;
  Hierarchy hierarchy(params);
  hierarchy.build(points, box);
  return hierarchy;
}

/// Some of a point's neighbors, most of them, all and more. The rows of one question are those of the next.
void expect_all_neighbors(const std::vector<Vec3>& points, const Box& box, double radius,
                          const std::string& what) {
  const RestoreInstructionSet restore;
  const std::vector<SortedRow> expected = all_pairs_sorted(points, box);
  Hierarchy hierarchy = hierarchy_in(points, box, radius);
  NearestRows rows;
  const auto n = static_cast<std::int32_t>(points.size());
  for (const std::int32_t k : {1, 12, 70, 2, 200, n - 1, n + 3, 1}) {
    for (const InstructionSet set : supported_sets()) {
      if (k >= n - 1 && set != supported_sets().back()) continue;
      set_instruction_set(set);
      Nearest(hierarchy.view()).of_points({k}, rows);
      ASSERT_NO_FATAL_FAILURE(expect_rows(rows, expected, what + ", k " + std::to_string(k)));
    }
  }
}

/// About the middle of a cell of width 10, at distances of which there are as many between 1e-6 and 1e-5 as
/// between 1e-1 and 1.
std::vector<Vec3> denser_and_denser(std::size_t n) {
  scenes::Random random(7);
  std::vector<Vec3> points(n);
  for (Vec3& p : points) p = kDensest + std::pow(10, random.uniform(-6, 0)) * random.in_cube(5);
  return points;
}

/// Uniform, but every other point at one of two places.
std::vector<Vec3> half_at_two_places(std::size_t n) {
  std::vector<Vec3> points = scenes::uniform(n, {10, 10, 10}, 8);
  for (std::size_t k = 0; k < n; k += 2) points[k] = k % 4 == 0 ? kDensest : kDensest + Vec3{1e-9, 0, 0};
  return points;
}

std::vector<Vec3> cubic_lattice(int side) {
  std::vector<Vec3> points;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) points.push_back({0.7 * x, 0.7 * y, 0.7 * z});
  return points;
}

TEST(NearestOfAll, IsRightWhereDensityVariesWithinALeaf) {
  for (const scenes::NamedBox& box : scenes::all_boxes(10))
    ASSERT_NO_FATAL_FAILURE(expect_all_neighbors(denser_and_denser(450), box.box, 1.5, box.name));
  expect_all_neighbors(denser_and_denser(1400), Box::none(), 1.5, "many");
}

TEST(NearestOfAll, IsRightWherePointsCoincide) {
  expect_all_neighbors(half_at_two_places(700), Box::none(), 1.5, "none");
  expect_all_neighbors(half_at_two_places(700), Box::orthorhombic({10, 11, 12}), 1.5, "orthorhombic");
}

TEST(NearestOfAll, IsRightWhereManyAreEquallyNear) {
  expect_all_neighbors(cubic_lattice(10), Box::none(), 1.5, "none");
  expect_all_neighbors(cubic_lattice(10), Box::orthorhombic({7, 7, 7}), 1.5, "orthorhombic");
}

TEST(NearestOfAll, IsRightAtAnyScale) {
  for (const double unit : {1e-29, 1e-22, 1e-19, 1e-15, 1e15, 1e17, 1e19, 1e22, 1e29}) {
    std::vector<Vec3> points = denser_and_denser(400);
    for (Vec3& p : points) p = unit * p;
    ASSERT_NO_FATAL_FAILURE(
        expect_all_neighbors(points, Box::none(), unit, "unit " + std::to_string(std::log10(unit))));
  }
}

// The memory of rows is taken again, and what stands in it from before is no answer.
TEST(NearestOfAll, RowsOfPointsThatWentAreEmpty) {
  const std::vector<Vec3> points = scenes::uniform(500, {10, 10, 10}, 9);
  Hierarchy hierarchy = hierarchy_in(points, Box::none(), 1.5);
  NearestRows rows = Nearest(hierarchy.view()).of_points({4});
  hierarchy.remove(17);
  hierarchy.remove(499);
  const std::size_t places = rows.id.capacity();
  Nearest(hierarchy.view()).of_points({3}, rows);
  EXPECT_EQ(rows.id.capacity(), places);
  ASSERT_EQ(rows.size(), 500u);
  for (const std::size_t id : {std::size_t{17}, std::size_t{499}}) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(rows.id[3 * id + j], -1);
      EXPECT_EQ(rows.distance2[3 * id + j], kNoDistance);
    }
  }
  EXPECT_EQ(std::count(rows.id.begin(), rows.id.end(), -1), 6);
}

// Nearly all points find their neighbors near their leaf, without a descent of their own.
TEST(NearestOfAll, LooksAtAFewHundredOthersForEachPoint) {
  const std::vector<Vec3> points = scenes::uniform(27000, {30, 30, 30}, 3);
  Hierarchy hierarchy = hierarchy_in(points, Box::none(), 1.5);
  const auto n = static_cast<std::int64_t>(points.size());
  for (const auto& [k, nodes, blocks, others] :
       {std::array<std::int32_t, 4>{1, 1, 20, 215}, {12, 1, 28, 400}}) {
    const NearestWork work = Nearest(hierarchy.view()).of_points({k}).work;
    std::printf("%d nearest: %.2f nodes, %.1f blocks, %.1f points for each point\n", k,
                static_cast<double>(work.nodes) / static_cast<double>(n),
                static_cast<double>(work.blocks) / static_cast<double>(n),
                static_cast<double>(work.points) / static_cast<double>(n));
    EXPECT_LE(work.nodes, nodes * n) << k;
    EXPECT_LE(work.blocks, blocks * n) << k;
    EXPECT_LE(work.points, others * n) << k;
  }
}

}  // namespace
}  // namespace dch
