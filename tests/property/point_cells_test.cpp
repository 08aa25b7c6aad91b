// SPDX-License-Identifier: MIT
//
// Points in cells, asked without what stands behind them, against all points: at distances that rounding
// decides, near the origin and as far out as cells go, and where points far away have the names of near ones.
//
// More than 300 lines: all tests take the same scene and comparisons.
#include "point_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>

#include "effort.hpp"
#include "nearest_oracle.hpp"
#include "point_cell_search.hpp"
#include "scenes.hpp"
#include "special_numbers.hpp"

namespace dch {
namespace {

using detail::PointCells;
using detail::PointCellSearch;

struct CellScene {
  CellScene(const std::vector<Vec3>& points, const Box& box, double width) : hierarchy(params_for(width)) {
    hierarchy.build(points, box);
    grid.make(hierarchy.kept_view().structure(), width);
  }
  static HierarchyParams params_for(double width) {
    HierarchyParams params;
    params.radius = 1.5 * width;
    return params;
  }
  double distance(Vec3 from, std::int32_t id) {
    const HierarchyView view = hierarchy.kept_view();
    return std::sqrt(view.box().distance2(from, view.position(id)));
  }
  bool finds(std::int32_t id) const {
    const auto found = search.found();
    return std::count_if(found.begin(), found.end(), [&](const auto& each) { return each.id == id; }) == 1;
  }

  Hierarchy hierarchy;
  PointCells grid;
  PointCellSearch search;
};

/// Where cells and their units begin, or a little below, as computed.
class Borders {
 public:
  Borders(std::uint64_t seed, Vec3 from, double width) : random(seed), from_(from), width_(width) {}
  Vec3 somewhere(double cells) {
    Vec3 at;
    for (int axis = 0; axis < 3; ++axis) {
      const double units = random.below(2) == 0 ? 0 : static_cast<double>(random.below(PointCells::kUnits));
      at[axis] = from_[axis] + width_ * (std::floor(random.uniform(0, cells)) + units / PointCells::kUnits);
      if (random.below(2) == 0) at[axis] = std::nextafter(at[axis], -kInfinity);
    }
    return at;
  }
  scenes::Random random;

 private:
  Vec3 from_;
  double width_;
};

void check_within(CellScene& scene, Borders& borders, Vec3 from, int points, int& answered) {
  for (std::int32_t id = 0; id < points; ++id) {
    Vec3 at = borders.somewhere(8);
    const int along = static_cast<int>(borders.random.below(4));  // one axis, or all
    for (int axis = 0; axis < 3 && along < 3; ++axis)
      if (axis != along) at[axis] = scene.hierarchy.kept_view().position(id)[axis];
    const double distance = scene.distance(at, id);
    if (distance > 2 * scene.grid.least_width() || !scene.search.within(scene.grid, at, distance)) continue;
    ++answered;
    ASSERT_TRUE(scene.finds(id)) << "from " << from.x << ", point " << id << ", at " << distance;
  }
}

TEST(PointCells, FindAllWithinADistanceThatRoundingDecides) {
  constexpr int kPoints = 500;
  scenes::Random random(81);
  int answered = 0;
  for (int k = 0; k < effort(200); ++k) {
    const double width = random.uniform(0.5, 2);
    const bool is_periodic = k % 4 == 0;
    const double side = width * (k % 8 == 0 ? 8 : 16);
    const double far = is_periodic ? side * std::floor(0x1p24 * random.uniform())
                                   : width * std::floor(0x1p29 * random.uniform());
    const Vec3 from = k % 2 == 0 ? Vec3{far, -far, far / 2} : Vec3{};
    Borders borders(8200 + static_cast<std::uint64_t>(k), from, width);
    std::vector<Vec3> points;
    for (int p = 0; p < kPoints; ++p) points.push_back(borders.somewhere(8));
    if (!is_periodic) points.push_back({0, 0, 0});
    CellScene scene(points, is_periodic ? Box::orthorhombic({side, side, side}) : Box::none(),
                    is_periodic ? 0.999999 * width : width);
    ASSERT_FALSE(scene.grid.empty());
    ASSERT_NO_FATAL_FAILURE(check_within(scene, borders, from, kPoints, answered));
  }
  EXPECT_GE(answered, effort(200) * kPoints / 8);
}

/// What is found, where k of it are within the bound, beside all points.
void check_nearest(CellScene& scene, Vec3 at, std::int32_t k, double epsilon, int& shown, int& hidden) {
  if (!scene.search.nearest(scene.grid, at, k, epsilon)) return;
  const HierarchyView view = scene.hierarchy.kept_view();
  std::vector<Neighbor> found;
  for (const auto& each : scene.search.found())
    found.push_back({view.box().distance2(at, view.position(each.id)), each.id});
  std::sort(found.begin(), found.end());
  const auto kth = static_cast<std::size_t>(k - 1);
  if (found.size() <= kth || std::sqrt(found[kth].distance2) > scene.search.bound()) {
    ++hidden;
    return;
  }
  ++shown;
  const std::vector<Neighbor> all = sorted_by_distance(view, at, -1);
  for (std::size_t j = 0; j <= kth; ++j) {
    if (epsilon == 0) {
      ASSERT_EQ(found[j].id, all[j].id) << "neighbor " << j << " of " << k;
    } else {
      ASSERT_LE(std::sqrt(found[j].distance2), (1 + epsilon) * std::sqrt(all[j].distance2));
    }
  }
}

/// Points around a few centers, on spheres: many are as near to a center, up to rounding.
std::vector<Vec3> on_spheres(scenes::Random& random, const std::vector<Vec3>& centers, double width,
                             int points) {
  std::vector<Vec3> all;
  for (int p = 0; p < points; ++p) {
    Vec3 d = random.in_cube(1);
    d = (width * (0.5 + 0.25 * static_cast<double>(random.below(6))) / std::sqrt(norm2(d))) * d;
    all.push_back(centers[random.below(centers.size())] + d);
  }
  return all;
}

/// In a periodic box without a hash table no other cell has the name and the line of a near one, so an answer
/// is always shown to be right.
TEST(PointCells, HaveTheNearestPointsOfPeriodicBoxes) {
  scenes::Random random(83);
  int shown = 0, hidden = 0;
  for (int k = 0; k < effort(100); ++k) {
    const double width = random.uniform(0.5, 2);
    const auto side = [&] { return width * (8.01 + random.uniform(0, 2)); };
    const Vec3 sides{side(), side(), side()};
    std::vector<Vec3> centers;
    for (int c = 0; c < 12; ++c)
      centers.push_back({random.uniform(0, sides.x), random.uniform(0, sides.y), random.uniform(0, sides.z)});
    CellScene scene(on_spheres(random, centers, width, 1100), Box::orthorhombic(sides), width);
    ASSERT_FALSE(scene.grid.empty());
    for (const Vec3 at : centers)
      for (const std::int32_t wanted : {1, 2, 5, 20, 60})
        ASSERT_NO_FATAL_FAILURE(check_nearest(scene, at, wanted, wanted == 5 ? 0.3 : 0, shown, hidden));
  }
  EXPECT_GE(shown, effort(100) * 24);
  EXPECT_EQ(hidden, 0);
}

/// Of an open box, whose cells share lines: points sixteen cells or some multiples of that away are found
/// too.
TEST(PointCells, AreNotMisledByPointsOfOtherCells) {
  scenes::Random random(84);
  int shown = 0, hidden = 0;
  for (int k = 0; k < effort(300); ++k) {
    std::vector<Vec3> centers;
    for (int c = 0; c < 6; ++c) centers.push_back(random.in_cube(k % 2 == 0 ? 2 : 20));
    std::vector<Vec3> points = on_spheres(random, centers, 1, 150);
    CellScene scene(points, Box::none(), 1);
    ASSERT_FALSE(scene.grid.empty());
    for (int p = 0; p < 60; ++p) {
      const Vec3 cells{static_cast<double>(random.below(3)), static_cast<double>(random.below(3)),
                       static_cast<double>(random.below(3))};
      const Vec3 at = points[random.below(points.size())] + 16.0 * cells + random.in_cube(0.3);
      const std::int32_t id = scene.hierarchy.insert(at);
      scene.grid.grow(scene.hierarchy.capacity());
      scene.grid.insert(id, at);
    }
    for (const Vec3 at : centers)
      for (const std::int32_t wanted : {1, 2, 5, 20})
        ASSERT_NO_FATAL_FAILURE(check_nearest(scene, at, wanted, wanted == 5 ? 0.3 : 0, shown, hidden));
  }
  EXPECT_GE(shown, effort(300) * 5);
  EXPECT_GE(hidden, effort(300) / 20);
}

/// Whole numbers, the squares of which sum up to n; 0 if none are found.
std::array<std::int64_t, 3> three_squares(std::int64_t n) {
  for (std::int64_t x = 0; x < 100; ++x)
    for (std::int64_t y = 0; x * x + y * y <= n; ++y) {
      const std::int64_t rest = n - x * x - y * y;
      const auto z = static_cast<std::int64_t>(std::llround(std::sqrt(static_cast<double>(rest))));
      if (z * z == rest) return {x, y, z};
    }
  return {};
}

/// A position far out, a near point in the next cell, and by how much rounding has the cell look farther than
/// the point.
struct AcrossABorder {
  AcrossABorder(scenes::Random& random, double width) {
    const double border = std::floor(random.uniform(0x1p29, 0x1.fp29)), per_length = 1 / width;
    for (near = border * width * (1 + 0x1p-50); near * per_length >= border;) near = std::nextafter(near, 0);
    near = std::nextafter(near, kInfinity);
    double x = (border - 0.6) * width;
    for (int k = 0; k < 100; ++k, x = std::nextafter(x, kInfinity)) {
      const double gained = (border - x * per_length) * width - (near - x);
      if (gained <= hidden) continue;
      hidden = gained;
      at = x;
    }
  }
  double at = 0, near = 0, hidden = 0;
};

/// The bound is that of a point sixteen cells away or more, which seems to be near, and less than the border
/// of the eight nearest cells seems to be away. A point beyond the border is nearer than the bound all the
/// same, and nearer than the one in the same cell.
TEST(PointCells, LookBeyondABorderThatRoundingMayHaveMovedAway) {
  scenes::Random random(85);
  int shown = 0, hidden = 0;
  for (int k = 0; k < effort(2000); ++k) {
    const double width = random.uniform(0.05, 0.2), unit = width / PointCells::kUnits;
    const AcrossABorder x(random, width);
    const double nearest = x.near - x.at, low = 0.02 * width;
    const double units = (nearest + x.hidden / 2) / unit - PointCells::kSteps;
    const auto squares = static_cast<std::int64_t>(std::llround(units * units));
    const double bound = (std::sqrt(static_cast<double>(squares)) + PointCells::kSteps) * unit;
    if (!(bound > nearest * 1.00000001 && bound < nearest + 0.9 * x.hidden)) continue;
    const std::array<std::int64_t, 3> off = three_squares(squares);
    const auto middle = [&](double from, std::int64_t off_by) {
      return (std::floor(from / unit) + static_cast<double>(off_by) + 0.5) * unit;
    };
    const double far = 16 * width * static_cast<double>(1 + random.below(8));
    const Vec3 at{x.at, low, low};
    CellScene scene({{0, 0, 0},
                     {x.at, low + (nearest + bound) / 2, low},
                     {x.near, low, low},
                     {middle(x.at, -off[0]), middle(low, off[1]), middle(low, off[2]) + far}},
                    Box::none(), width);
    ASSERT_FALSE(scene.grid.empty());
    ASSERT_NO_FATAL_FAILURE(check_nearest(scene, at, 1, 0, shown, hidden)) << k;
  }
  EXPECT_GE(shown, effort(2000) / 20);
}

/// Coordinates start anew after sixteen cells. Where the period were no multiple of that, a hash table of few
/// lines would have two neighboring cells of one name on one line.
TEST(PointCells, AreFoundOnceAcrossTheBorderOfAPeriod) {
  scenes::Random random(86);
  int answered = 0;
  for (int k = 0; k < effort(300); ++k) {
    std::vector<Vec3> points;
    for (int p = 0; p < 20; ++p) points.push_back(random.in_cube(1.5));
    CellScene scene(points, Box::orthorhombic({17.5, 17.2, 18.9}), 1);
    ASSERT_FALSE(scene.grid.empty());
    for (std::int32_t id = 0; id < 20; ++id) {
      const Vec3 at = random.in_cube(1);
      const double distance = scene.distance(at, id);
      if (distance > 2 || !scene.search.within(scene.grid, at, distance)) continue;
      ++answered;
      ASSERT_TRUE(scene.finds(id)) << "scene " << k << ", point " << id;
    }
  }
  EXPECT_GE(answered, effort(300) * 5);
}

TEST(PointCells, AreNoneInPeriodicBoxesOfFewCells) {
  scenes::Random random(87);
  const auto has_cells = [&](double side, std::size_t points) {
    const Vec3 sides{side, 20, 20};
    std::vector<Vec3> places;
    for (std::size_t k = 0; k < points; ++k)
      places.push_back(scenes::from_fractional(Box::orthorhombic(sides), random.in_cube(0.5)));
    return !CellScene(places, Box::orthorhombic(sides), 1).grid.empty();
  };
  EXPECT_FALSE(has_cells(7.99, 3000));
  EXPECT_TRUE(has_cells(8.01, 3300));
  EXPECT_FALSE(has_cells(15.99, 30));
  EXPECT_TRUE(has_cells(16.01, 30));
}

TEST(PointCells, AreNoneTooFarOutForTheirCoordinates) {
  constexpr double kFarOut = 0x1p31;
  EXPECT_TRUE(CellScene({{0, 0, 0}, {kFarOut, 0, 0}}, Box::none(), 1).grid.empty());
  EXPECT_TRUE(CellScene({{kFarOut, 0, 0}, {kFarOut + 1, 1, 1}}, Box::none(), 1).grid.empty());
  CellScene scene({{0, 0, 0}, {1, 1, 1}}, Box::none(), 1);
  ASSERT_FALSE(scene.grid.empty());
  EXPECT_TRUE(scene.search.nearest(scene.grid, {0, 0, 0}, 1, 0));
  EXPECT_FALSE(scene.search.nearest(scene.grid, {0, -kFarOut, 0}, 1, 0));
  scene.grid.grow(3);
  scene.grid.insert(2, {0, -kFarOut, 0});
  EXPECT_TRUE(scene.grid.empty());
}

}  // namespace
}  // namespace dch
