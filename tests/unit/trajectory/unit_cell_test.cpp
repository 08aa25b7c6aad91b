// SPDX-License-Identifier: MIT
#include "frames/unit_cell.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace dch::trajectory {
namespace {

TEST(UnitCell, HasTheLengthsAndAngles) {
  const Cell cell = cell_from_angles({3, 4, 5}, 70, 80, 100);
  const auto& [a, b, c] = cell.edges;
  const auto angle = [](Vec3 u, Vec3 v) {
    return std::acos(dot(u, v) / std::sqrt(norm2(u) * norm2(v))) * 180 / M_PI;
  };
  EXPECT_NEAR(std::sqrt(norm2(a)), 3, 1e-14);
  EXPECT_NEAR(std::sqrt(norm2(b)), 4, 1e-14);
  EXPECT_NEAR(std::sqrt(norm2(c)), 5, 1e-14);
  EXPECT_NEAR(angle(b, c), 70, 1e-12);
  EXPECT_NEAR(angle(a, c), 80, 1e-12);
  EXPECT_NEAR(angle(a, b), 100, 1e-12);
  EXPECT_EQ(a.y, 0);
  EXPECT_EQ(a.z, 0);
  EXPECT_EQ(b.z, 0);
}

TEST(UnitCell, IsExactForRightAngles) {
  EXPECT_EQ(cell_from_angles({3, 4, 5}, 90, 90, 90).box(), Box::orthorhombic({3, 4, 5}));
}

TEST(UnitCell, RefusesAnglesThatDoNotClose) {
  EXPECT_THROW(cell_from_angles({3, 4, 5}, 60, 60, 130).box(), InvalidBox);
}

TEST(UnitCell, IsNoneIfAllIsZero) { EXPECT_EQ(cell_from_angles({0, 0, 0}, 90, 90, 90).box(), Box::none()); }

}  // namespace
}  // namespace dch::trajectory
