// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <dch/base/vec3.hpp>
#include <dch/kinetic/flight_plan.hpp>

namespace dch::kinetic {

/// How long a sphere stays in a ball: until it is d + g t off its center, with g <= 0. It is r off now.
inline double time_to_exit(Vec3 r, Vec3 v, double d, double g) {
  const double excess = norm2(r) - d * d;
  if (d <= 0 || excess >= 0) return 0;
  const double half = dot(r, v) - d * g, square = norm2(v) - g * g;
  const double root = std::sqrt(std::max(0.0, half * half - square * excess));
  if (half > 0) return -excess / (half + root);
  return square > 0 ? (root - half) / square : kNever;
}

}  // namespace dch::kinetic
