// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <dch/base/vec3.hpp>
#include <dch/kinetic/flight_plan.hpp>

namespace dch::kinetic {

/// The discriminant of |r + v t| = d + g t, over 4, in a form that cancels nothing where r is far longer than
/// d.
inline double contact_discriminant(Vec3 r, Vec3 v, double d, double g) {
  return norm2(d * v - g * r) - norm2(cross(r, v));
}

/// How long until two spheres touch that are r apart, move by v relative to each other, and whose distance of
/// contact is d and grows by g >= 0; slightly negative if rounding has them overlap and they approach. A pair
/// that grazes has no contact, and neither has one that touches and parts.
inline double time_to_contact(Vec3 r, Vec3 v, double d, double g) {
  const double half = dot(r, v) - d * g;
  if (half >= 0 && g == 0) return kNever;
  const double square = norm2(v) - g * g;
  if (half >= 0 && square >= 0) return kNever;
  const double discriminant = contact_discriminant(r, v, d, g);
  if (!(discriminant > 0)) return kNever;
  const double root = std::sqrt(discriminant);
  return half < 0 ? (norm2(r) - d * d) / (root - half) : (half + root) / -square;
}

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
