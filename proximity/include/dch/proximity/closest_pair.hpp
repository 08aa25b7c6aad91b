// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

#include <dch/proximity/point_tree.hpp>

#pragma GCC visibility push(default)
namespace dch {

struct ClosestPoints {
  std::int32_t a = -1, b = -1;  ///< ids, the smaller one first; -1 if there are fewer than two points
  double distance2 = std::numeric_limits<double>::infinity();  ///< of nearest images [length^2]
  std::int64_t looked_at = 0;                                  ///< pairs of nodes that were compared
};

/// The two points with the smallest distance (thesis 5.6.10, which needs the edges of full depth); of several
/// such pairs the one with the smallest ids. Pairs of nodes are taken in the order of their distance; O(n) of
/// them at bounded ratios of distances to nearest neighbors, and for points that coincide.
ClosestPoints closest_pair(const PointTree& tree);

}  // namespace dch
#pragma GCC visibility pop
