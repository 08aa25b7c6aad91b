// SPDX-License-Identifier: MIT
//
// Boxes and points far from the origin, where the rounding of coordinates is as large as the cutoff.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "error_message.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Box box_at(Vec3 corner, double side, bool skewed) {
  if (!skewed) return Box::orthorhombic({side, side, side}, {true, true, true}, corner);
  return Box::triclinic({side, 0, 0}, {side / 3, side, 0}, {-side / 4, side / 7, side}, {true, true, true},
                        corner);
}

/// Points around the corner of a box, each moved by up to so many periods along each vector.
std::vector<Vec3> around_corner(const Box& box, double extent, double periods, std::uint64_t seed) {
  scenes::Random random(seed);
  std::vector<Vec3> points;
  for (int k = 0; k < 60; ++k) {
    Vec3 p = box.origin() + random.in_ball(extent);
    for (int axis = 0; axis < 3; ++axis)
      p = p + std::nearbyint(random.uniform(-periods, periods)) * box.vector(axis);
    points.push_back(p);
  }
  return points;
}

/// Whether the engines answered at all.
bool expect_all_pairs(const std::vector<Vec3>& points, const Box& box, double radius) {
  ListParams params;
  params.cutoffs = TypeCutoffs(radius);
  const auto cells = make_cell_search(radius), hierarchy = make_dch_search(radius);
  try {
    const NeighborList expected = all_pairs(points, box, params);
    for (const auto& search : {cells.get(), hierarchy.get()}) {
      search->update(points, box);
      EXPECT_EQ(first_difference(search->list(params), expected), "") << search->name();
    }
  } catch (const InvalidPosition&) {
    return false;
  }
  return true;
}

TEST(FarBoxes, EnginesGiveTheListOfAllPairs) {
  int answered = 0;
  for (const double side : {10.0, 9.1})
    for (const bool skewed : {false, true})
      for (const double corner : {0.0, 1e9, 1e12, 1e13, 1e15})
        for (const double periods : {0.0, 1e3, 1e9, 1e11, 1e12})
          for (const double radius : {1.0, 1e-2, 1e-4}) {
            SCOPED_TRACE("side " + std::to_string(side) + ", corner " + std::to_string(corner) +
                         ", periods " + std::to_string(periods) + ", radius " + std::to_string(radius));
            const Box box = box_at({corner, -corner, corner}, side, skewed);
            answered += expect_all_pairs(around_corner(box, 2 * radius, periods, 3), box, radius);
            ASSERT_FALSE(HasFailure());
          }
  EXPECT_GT(answered, 200);
}

TEST(FarBoxes, OpenSpaceIsTheSameAnywhere) {
  for (const double far : {1e6, 1e9, 1e12, 1e15})
    for (const double share : {1e-15, 1e-14, 1e-12, 1e-9}) {
      const double radius = share * far;
      std::vector<Vec3> points = scenes::uniform(300, {5 * radius, 5 * radius, 5 * radius}, 4);
      for (Vec3& p : points) p = p + Vec3{far, -far, 0.3 * far};
      SCOPED_TRACE(far);
      EXPECT_TRUE(expect_all_pairs(points, Box::none(), radius)) << share;
    }
}

// Beyond 2^53 cells from the origin the product of a coordinate and the cells' density rounds to more than a
// cell, but the difference of two coordinates is exact.
TEST(FarBoxes, CellsFinerThanTheSpacingOfCoordinatesMissNoPair) {
  for (const double far : {1e9, 1.9e9, 1e15, -1.1e15}) {
    const double spacing = std::nextafter(std::abs(far), INFINITY) - std::abs(far);
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Vec3> points(200);
      for (std::size_t k = 0; k < points.size(); ++k)
        points[k][axis] = far + static_cast<double>(k) * spacing;
      for (const double steps : {1.0, 2.0}) {
        ListParams params;
        params.cutoffs = TypeCutoffs(steps * spacing);
        const NeighborList expected = all_pairs(points, Box::none(), params);
        ASSERT_EQ(expected.pairs(), steps == 1 ? 199 : 199 + 198);
        for (const int divisions : {1, 2, 3}) {
          const auto cells = make_cell_search(steps * spacing, divisions);
          cells->update(points, Box::none());
          EXPECT_EQ(first_difference(cells->list(params), expected), "") << far << ", " << divisions;
        }
      }
    }
  }
}

TEST(FarBoxes, WhereRoundingLosesTheBoxTheRemedyIsToShiftIt) {
  const Box box = Box::orthorhombic({10, 10, 10}, {true, true, true}, {1e17, 0, 0});
  const auto cells = make_cell_search(1);
  EXPECT_THAT(test::message_of<InvalidPosition>([&] {
                cells->update(std::vector<Vec3>{{1e17, 0, 0}}, box);
              }),
              AllOf(HasSubstr("at most 5 is allowed"), HasSubstr("shift the box")));
  const Box open = Box::orthorhombic({10, 10, 10}, {false, true, true}, {1e17, 0, 0});
  EXPECT_NO_THROW(cells->update(std::vector<Vec3>{{1e17, 0, 0}}, open)) << "no coordinate is shifted along x";
}

// Thresholds follow how far out the points are; edges made when they were farther are longer than the present
// ones would be.
TEST(FarBoxes, HierarchyStaysValidWhenPointsComeBack) {
  for (const bool skewed : {false, true})
    for (const double periods : {1e9, 1e11, 1e12}) {
      const Box box = box_at({0, 0, 0}, 10, skewed);
      StructureParams params;
      params.radius = 1;
      params.base_radius = 0.3;
      params.policy = MaintenancePolicy::always_repair;
      params.max_roots = 4;
      ListedHierarchy hierarchy(params);
      scenes::Random random(5);
      std::vector<Vec3> points = scenes::uniform_in(box, 200, 6);
      hierarchy.build(points, box);
      for (int step = 0; step < 9; ++step) {
        const double away = step % 3 == 2 ? 0 : periods;
        std::vector<Vec3> moved;
        for (Vec3& p : points) {
          p = p + random.in_ball(0.02);
          moved.push_back(p);
          for (int axis = 0; axis < 3; ++axis)
            moved.back() = moved.back() + std::nearbyint(random.uniform(-away, away)) * box.vector(axis);
        }
        hierarchy.update(moved, box);
        ASSERT_EQ(hierarchy.validate(), "") << periods << " periods, step " << step;
      }
    }
}

// A class of particles whose radii are below the least list radius of a hierarchy.
TEST(ExtremeSizes, ClassesOfAnyRatioGiveTheListOfAllPairs) {
  std::vector<Vec3> points = scenes::uniform(90, {3, 3, 3}, 8);
  points[1] = points[2];
  std::vector<double> radii(points.size(), 1e-300);
  for (std::size_t k = 0; k < radii.size(); k += 3) radii[k] = 0.5;
  ListParams params;
  params.radii = radii;
  StructureParams structure;
  structure.radius = params.list_radius();
  structure.size_classes = true;
  const auto search = make_dch_search(structure);
  search->update(points, Box::none());
  const NeighborList expected = all_pairs(points, Box::none(), params);
  EXPECT_GT(expected.pairs(), 30);
  EXPECT_EQ(first_difference(search->list(params), expected), "");
}

}  // namespace
}  // namespace dch
