// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch::zonotope {

/// Coordinates of centers and generators may not be larger in magnitude [length].
constexpr double kMaxMagnitude = 1e100;

/// The points center + sum of delta_k generators[k] with -1 <= delta_k <= 1: the Minkowski sum of line
/// segments of twice the length of the generators, moved to the center (thesis 3.3). Generators may be zero,
/// parallel, coplanar or none at all; then the zonotope is flat, a segment or a point, and everything here
/// holds for it, where the thesis asks for any three to be linearly independent. With n of them in general
/// position it has n (n - 1) + 2 vertices and n (n - 1) facets; the list of generators stands for all of
/// those.
struct Zonotope {
  Vec3 center;                   ///< [length]
  std::vector<Vec3> generators;  ///< half of each edge [length]
};

/// @throws InvalidPosition that names a center or generator which is not finite or beyond kMaxMagnitude
void check(const Zonotope& z);

/// The Minkowski sum {p + q}: centers are added, generators listed one after the other. O(n).
Zonotope sum(const Zonotope& a, const Zonotope& b);

/// The Minkowski difference {p - q} of the thesis (3.1), which holds 0 where the two intersect; its center is
/// rounded. O(n). It is no inverse of sum().
Zonotope difference(const Zonotope& a, const Zonotope& b);

/// max of direction . p over the zonotope's points p [length times that of direction]. O(n).
double support(const Zonotope& z, Vec3 direction);

/// A point where support() is reached; where a whole edge or facet does, its middle. O(n).
Vec3 support_point(const Zonotope& z, Vec3 direction);

/// 8 times the sum of |det| over all triples of generators [length^3]. All terms have one sign, so that the
/// relative error is a few roundings. O(n^3) time.
/// @throws InvalidPosition as check()
double volume(const Zonotope& z);

/// 8 times the sum of |v x w| over all pairs of generators [length^2]; of a flat zonotope both sides count.
/// O(n^2).
/// @throws InvalidPosition as check()
double surface_area(const Zonotope& z);

/// The same set by as few generators as there are directions: zero ones are left out, those that are
/// parallel, decided without rounding, become one (the sum, rounded, of their lengths). Each points to where
/// its first coordinate that is not 0 is positive. The order is by direction, so that the order given does
/// not matter but for how sums round. O(n log n).
/// @throws InvalidPosition as check()
Zonotope canonical(const Zonotope& z);

}  // namespace dch::zonotope
#pragma GCC visibility pop
