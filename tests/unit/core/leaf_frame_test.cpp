// SPDX-License-Identifier: MIT
//
// Units, origins and shifts of the integers that lists and cluster pairs are found with.
#include "leaves/leaf_frame.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace dch::detail {
namespace {

double finest(double widest) { return widest * (1 + 1e-9) / 31768; }

double period_off(const Box& box, double unit) {
  double off = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double units = box.vector(axis)[axis] / unit;
    if (box.periodic(axis)) off = std::max(off, std::abs(units - std::nearbyint(units)));
  }
  return off;
}

TEST(LeafFrame, UnitsAreTheFinestWherePeriodsSayNothing) {
  const Box skewed = Box::triclinic({10, 0, 0}, {1, 10, 0}, {0, 1, 10});
  const Box tiny = Box::orthorhombic({0.1, 0.1, 0.1}), huge = Box::orthorhombic({1e12, 1e12, 1e12});
  for (const Box& box : {Box::none(), skewed, tiny, huge}) EXPECT_EQ(frame_unit(box, 1.3), finest(1.3));
}

TEST(LeafFrame, PeriodsAreAsNearToIntegersAsForAnyOfFortyUnits) {
  for (const Box& box : {Box::orthorhombic({10, 10, 10}), Box::orthorhombic({10, 10.37, 9.1}),
                         Box::orthorhombic({3, 11.3, 7.7}, {false, true, true}),
                         Box::orthorhombic({3, 5, 7.7}, {false, false, true})}) {
    const double unit = frame_unit(box, 1.3);
    const int axis = box.periodic(0) ? 0 : box.periodic(1) ? 1 : 2;
    const double period = box.vector(axis)[axis], most = std::floor(period / finest(1.3));
    double least = 1;
    for (int k = 0; k < 40; ++k) least = std::min(least, period_off(box, period / (most - k)));
    EXPECT_EQ(period_off(box, unit), least);
    EXPECT_GE(unit, finest(1.3));
    EXPECT_LT(unit, 1.01 * finest(1.3));
  }
}

TEST(LeafFrame, ShiftsAreOffByPeriodsAndRoundings) {
  const Box brick = Box::orthorhombic({10, 10.37, 9.1}),
            skewed = Box::triclinic({10, 0, 0}, {1, 10, 0}, {0, 1, 10});
  const auto error = [](const Box& box, double unit, bool one_image, double far) {
    ShiftError of(box, unit, one_image);
    of.add(std::vector<Vec3>{{0, 0, 0}, {0, -far, 0}, {1, 0, 1}});
    return of.largest();
  };
  const double rounding = 16 * 0x1p-53;
  EXPECT_EQ(error(brick, 1e-3, false, 5), 0.5);
  EXPECT_EQ(error(skewed, 1e-3, true, 5), 0.5);
  EXPECT_EQ(error(Box::none(), 0.5, true, 0x1p43), rounding * 0x1p44);
  EXPECT_EQ(error(Box::none(), 0.5, true, 0x1p43 + 1), 0.5);
  EXPECT_EQ(error(Box::none(), 1e-3, true, 3), rounding * 3 / 1e-3);
  EXPECT_EQ(error(brick, 4e-3, true, 20), std::min(0.5, period_off(brick, 4e-3) + rounding * 30.37 / 4e-3));
  EXPECT_LT(error(brick, 1e-2, true, 20), 1e-9);
  const Box wide = Box::orthorhombic({0x1p18, 0x1p20, 0x1p19});
  EXPECT_EQ(error(wide, 0x1p-10, true, 0x1p22), rounding * (0x1p22 + 0x1p20) / 0x1p-10);
  EXPECT_EQ(error(wide, 0x1p-10, true, 0x1p34), 0.5);
}

TEST(LeafFrame, OriginsAreMultiplesOfTheUnitUnlessPositionsHaveNoSuchDigits) {
  const Vec3 center{3.1, -7.3, 12.9}, middle{0.013, -0.5, 0.25}, origin = frame_origin(center, middle, 0.25);
  EXPECT_EQ(center.x + origin.x, 3.0);
  EXPECT_EQ(center.y + origin.y, -7.75);
  EXPECT_NEAR(center.z + origin.z, 13.25, 0.13);
  EXPECT_EQ(std::fmod(center.z + origin.z, 0.25), 0.0);
  EXPECT_EQ(frame_origin({0x1p45, 0, 0}, middle, 1.0).x, middle.x);
}

TEST(LeafFrame, ShiftsHaveTwoPartsOfOneSign) {
  for (const double units :
       {0.0, 0.4, 0.6, -0.6, 1.0, -1.0, 7.2, -7.2, 32767.0, 65533.0, -65533.0, 65534.0}) {
    std::int16_t part[2];
    split_shift(units, part);
    EXPECT_EQ(part[0] + part[1], static_cast<int>(std::nearbyint(units)));
    EXPECT_GE(part[0] * part[1], 0);
    EXPECT_LE(std::abs(part[0] - part[1]), 1);
  }
  for (const double far : {65535.0, 1e9}) {
    std::int16_t part[2];
    split_shift(far, part);
    EXPECT_EQ(part[0] + part[1], 65534);
    split_shift(-far, part);
    EXPECT_EQ(part[0] + part[1], -65534);
  }
}

}  // namespace
}  // namespace dch::detail
