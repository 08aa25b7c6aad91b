// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "geometry/tolerance.hpp"

namespace dch::detail {

/// Radii of discrete centers are `base` times a power of two. The largest one that is surely smaller than a
/// distance > 0: centers of that radius tell two points so far apart. 0 where double precision holds none.
inline double center_radius_below(double distance, double base) {
  double radius = std::ldexp(base, std::ilogb(distance / base));
  while (radius * kInflate >= distance) radius *= 0.5;
  return radius;
}

}  // namespace dch::detail
