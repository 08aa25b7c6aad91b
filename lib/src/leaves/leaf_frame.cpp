// SPDX-License-Identifier: MIT
#include "leaves/leaf_frame.hpp"

#include <algorithm>
#include <cmath>

#include "base/nearest_integer.hpp"

namespace dch::detail {
namespace {

/// How much a period is off from an integer number of units, at most [units].
double period_error(const Box& box, double unit) {
  double error = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double units = box.vector(axis)[axis] / unit;
    if (box.periodic(axis)) error = std::max(error, std::abs(units - nearest_integer(units)));
  }
  return error;
}

double fitted_unit(const Box& box, double unit) {
  constexpr int kTrials = 40;
  constexpr double kLeast = 4096, kMost = 0x1p45;
  int axis = 0;
  while (axis < 3 && !box.periodic(axis)) ++axis;
  if (axis == 3 || box.kind() == Box::Kind::triclinic) return unit;
  const double period = box.vector(axis)[axis], units = std::floor(period / unit);
  double best = unit, least = 1;
  for (int k = 0; k < kTrials && units - k > kLeast && units < kMost; ++k) {
    const double error = period_error(box, period / (units - k));
    if (error >= least) continue;
    least = error;
    best = period / (units - k);
  }
  return best;
}

double origin_of(double center, double middle, double unit, double per_unit) {
  constexpr double kMost = 0x1p45;
  const double units = (center + middle) * per_unit;
  return std::abs(units) < kMost ? nearest_integer(units) * unit - center : middle;
}

}  // namespace

double frame_unit(const Box& box, double widest) {
  constexpr double kHalfPeriod = 0x1p15, kRoom = 1000;
  return fitted_unit(box, widest * (1 + 1e-9) / (kHalfPeriod - kRoom));
}

void ShiftError::add(Span<const Vec3> centers) {
  for (const Vec3 center : centers)
    far_ = std::max({far_, std::abs(center.x), std::abs(center.y), std::abs(center.z)});
}

double ShiftError::largest() const {
  constexpr double kRounded = 0.5, kRoundings = 16 * 0x1p-53, kFar = 0x1p44;
  if (!one_image_ || (box_.any_periodic() && box_.kind() == Box::Kind::triclinic)) return kRounded;
  double period = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (box_.periodic(axis)) period = std::max(period, box_.vector(axis)[axis]);
  if (far_ + period > kFar * unit_) return kRounded;
  return std::min(kRounded, period_error(box_, unit_) + kRoundings * (far_ + period) / unit_);
}

Vec3 frame_origin(Vec3 center, Vec3 middle, double unit) {
  const double per_unit = 1 / unit;
  return {origin_of(center.x, middle.x, unit, per_unit), origin_of(center.y, middle.y, unit, per_unit),
          origin_of(center.z, middle.z, unit, per_unit)};
}

void split_shift(double units, std::int16_t to[2]) {
  constexpr double kMost = 0xFFFE;  // twice the largest number of 16 bits: all saturate from there on
  const auto shift = static_cast<std::int32_t>(nearest_integer(std::clamp(units, -kMost, kMost)));
  to[0] = static_cast<std::int16_t>(shift / 2);
  to[1] = static_cast<std::int16_t>(shift - shift / 2);
}

}  // namespace dch::detail
