// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Most generators that zonotope_is_apart() takes: the number of its axes grows with the square.
inline constexpr std::size_t kMaxAxisGenerators = 16;

/// Whether the origin is farther than `margin` from the zonotope {center + sum of s_i g_i, -1 <= s_i <= 1},
/// proven by a separating axis; for two zonotopes, that of their difference (Lemma 3.5.1).
///
/// **True is certain**: each axis is taken as the vector of doubles that it is, and what rounding may do to
/// its test is added to the side of the zonotope. So nearly parallel generators, whose cross product is
/// mostly rounding, can cost a separation but not invent one. False says nothing certain: the origin is
/// inside, or within the margin, or within rounding (some 1e-15 of the sum of |center| and the generators'
/// lengths) of these, or with a margin > 0 near an edge or a vertex, whose normals are not among the axes.
///
/// Axes: the normals of the facets, which are cross products of two generators, and the direction of the
/// center. A zonotope that is flat, or a segment, has the normals of its edges in its plane besides, and for
/// a segment its direction, so that the test decides all of them up to rounding.
///
/// The generators are tried in the order of the pairs (0, 1), (0, 2), (1, 2), (0, 3), ..., and the test ends
/// at the first axis that separates: those likely to separate should come first. O(n^3) for n generators.
/// @param margin >= 0 [length]
/// @throws InvalidParameter for more than kMaxAxisGenerators generators and for a margin that is negative or
///   not finite.
bool zonotope_is_apart(Vec3 center, Span<const Vec3> generators, double margin = 0);

}  // namespace dch
#pragma GCC visibility pop
