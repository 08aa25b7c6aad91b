// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/vec3.hpp>
#include <dch/zonotope/zonotope.hpp>

#pragma GCC visibility push(default)
namespace dch::zonotope {

/// How far two zonotopes are apart.
struct Separation {
  double distance = 0;     ///< of the points below, 0 where the zonotopes intersect to rounding [length]
  double lower_bound = 0;  ///< the zonotopes are at least as far apart, to rounding [length]
  Vec3 direction;          ///< unit vector from a to b along which they are; 0 where they intersect
  Vec3 point_a, point_b;   ///< a closest pair of points [length]
  int iterations = 0;      ///< supports that were computed
};

/// Distance of two zonotopes by the algorithm of Gilbert, Johnson and Keerthi (IEEE J. Robot. Autom. 4:193,
/// 1988) on their Minkowski difference, whose support is a sum |direction . v| over the generators of both:
/// O(n) an iteration, and never a list of vertices. Relative error of the distance about 1e-12, absolute
/// error some roundings of the coordinates. `intersect` in membership.hpp has the answer without rounding.
/// @param start a direction from a to b to begin with, such as that of the time step before: where the
/// zonotopes have
///   moved little since, a few iterations are enough; 0 for none
/// @throws InvalidPosition as check()
Separation distance(const Zonotope& a, const Zonotope& b, Vec3 start = {});

}  // namespace dch::zonotope
#pragma GCC visibility pop
