// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "geometry/position_check.hpp"
#include "hierarchy/structure.hpp"

namespace dch::detail {

/// How far a distance that is computed from positions relative to leaves may be off, for lengths up to
/// `radius` [length].
inline double rounding_of_leaves(double radius) {
  constexpr double kRoundings = 32;
  return kRoundings * std::numeric_limits<double>::epsilon() * radius;
}

/// How far the distance of two wrapped positions of a hierarchy may be from their pair distance [length].
inline double distance_error(const Structure& hierarchy) {
  return WrapError(hierarchy.box).bound(hierarchy.largest_reach) +
         rounding_of_leaves(hierarchy.params.radius);
}

}  // namespace dch::detail
