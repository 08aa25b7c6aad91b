// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <dch/base/vec3.hpp>

namespace dch::necklace::detail {

/// Where two segments come closest, and how close.
struct ClosestOnSegments {
  double distance2 = 0;
  double on_p = 0, on_q = 0;  ///< 0 .. 1
};

/// Of the segments {p + s a} and {q + s b}, 0 <= s <= 1, with between = q - p. The closest points are an end
/// of one and a point of the other, or the feet of the common perpendicular: all five are tried, so parallel
/// segments and those of no length are no special cases.
inline ClosestOnSegments closest_on_segments(Vec3 a, Vec3 b, Vec3 between) {
  const auto clamped = [](double part, double whole) {
    return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
  };
  ClosestOnSegments best{norm2(between), 0, 0};
  const auto offer = [&](double s, double t) {
    const double distance2 = norm2(between + t * b - s * a);
    if (distance2 < best.distance2) best = {distance2, s, t};
  };
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), ad = dot(a, between), bd = dot(b, between);
  for (const double end : {0.0, 1.0}) {
    offer(end, clamped(end * ab - bd, bb));
    offer(clamped(end * ab + ad, aa), end);
  }
  const double determinant = aa * bb - ab * ab;
  if (determinant > 0) {
    const double s = (ad * bb - bd * ab) / determinant, t = (ad * ab - bd * aa) / determinant;
    if (s > 0 && s < 1 && t > 0 && t < 1) offer(s, t);
  }
  return best;
}

}  // namespace dch::necklace::detail
