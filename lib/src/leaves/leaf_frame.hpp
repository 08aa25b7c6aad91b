// SPDX-License-Identifier: MIT
//
// Frames of leaves: 16-bit integers relative to an origin in the middle of each, in one unit for all. They
// saturate when points are shifted to the frame of another leaf, and differences are taken modulo 2^16 or
// saturate.
#pragma once

#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

namespace dch::detail {

/// The finest unit in which lengths up to `widest` fit into 15 bits, with room for what roundings add, or one
/// hardly coarser, of which the periods of a brick are nearly integer numbers, if one is found soon [length].
double frame_unit(const Box& box, double widest);

/// By how much shifts between the frames of leaves with these centers are off at most, along an axis [units]:
/// origins differ by integers, but for a period, and for rounding of numbers as large as centers and periods;
/// far out origins are no multiples of the unit.
class ShiftError {
 public:
  ShiftError(const Box& box, double unit, bool one_image) : box_(box), unit_(unit), one_image_(one_image) {}
  void add(Span<const Vec3> centers);
  double largest() const;

 private:
  const Box& box_;
  double unit_;
  bool one_image_;
  double far_ = 0;
};

/// From the center of a leaf to the multiple of a unit that is nearest to its middle. Where positions have no
/// digits as fine, it is the middle itself: a sum with the center would round it off [length].
Vec3 frame_origin(Vec3 center, Vec3 middle, double unit);

/// A shift as two numbers of one sign, to be added one after the other, saturating [units].
void split_shift(double units, std::int16_t to[2]);

}  // namespace dch::detail
