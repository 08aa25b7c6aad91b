// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/vec3.hpp>
#include <dch/zonotope/zonotope.hpp>

#pragma GCC visibility push(default)
namespace dch::zonotope {

/// The norm whose unit ball is a zonotope moved to the origin (Corollary 3.5.4): the least t >= 0 with x in t
/// Z, and infinity if x is not in the space that the generators span, which is decided without rounding. The
/// facet that the ray to x meets is found as for contains(); where the generators span less than space, or
/// where doubles may have found a facet beside it that is off by more than 1e-12, without rounding. Relative
/// error about 1e-12. Expected O(n log^2 n).
/// @param z its center is of no meaning here
/// @throws InvalidPosition as check(), and for such an x
double norm(const Zonotope& z, Vec3 x);

/// norm(z, q - p): a metric if the generators span space, since zonotopes are symmetric around their centers.
double polyhedral_distance(const Zonotope& z, Vec3 p, Vec3 q);

}  // namespace dch::zonotope
#pragma GCC visibility pop
