// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/proximity/point_tree.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Centers for several numbers k at once.
struct KCenters {
  std::vector<std::int32_t> centers;  ///< ids; the first k of them are the centers for k
  std::vector<double> radius;  ///< for each k asked for: of the farthest point from its center [length]
  std::int64_t looked_at = 0;  ///< distances of centers from nodes that were computed
};

/// For each k, k of the points such that all points are near one of them: the largest distance from the
/// nearest center is at most 8 times the least that any k points have (thesis 5.6.12), in fact 4 times.
/// Distances are those of nearest images.
///
/// The centers are nested nets of the radii R_0 2^j: each net is made of the one before, of twice the radius,
/// and of points that none of its centers covers, found by descent in the tree. The levels of a hierarchy are
/// such nets too, but with a ratio of 8, since there a point may be two radii from its ancestor, and only
/// while no repair is put off. O(k + visits of nodes at the rims of balls) for each net.
/// @throws InvalidParameter for a k below 1 or above the number of points.
KCenters k_centers(const PointTree& tree, Span<const std::int64_t> k);

}  // namespace dch
#pragma GCC visibility pop
