// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/proximity/point_tree.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Two nodes of a PointTree whose balls are far apart for their size.
struct WellSeparatedPair {
  std::int32_t a = -1, b = -1;  ///< nodes, no point below both; of the tree until it is updated
  /// Whether the displacement from each point of one to each of the other is, by nearest images, that of the
  /// centers and of the points from their centers: no other image of a pair is as near. Always without a
  /// periodic box.
  bool has_one_image = true;
};

struct WellSeparatedPairs {
  std::vector<WellSeparatedPair> pairs;
  std::int64_t looked_at = 0;  ///< pairs of nodes whose balls were compared to find them
};

/// The s-well-separated pair decomposition of a tree's points (thesis 5.6.4, by descent from measured balls
/// in place of the conflict graph's edges): pairs of nodes such that each two points are below the two nodes
/// of one pair, and of one alone. The balls of a pair are at least s times the larger radius apart, so no two
/// of its points are nearer than that; with s for the radius twice the thesis's, which is for the diameter.
/// Points that coincide are no trouble: their balls have radius 0, and any distance will do.
///
/// Distances are those of nearest images. They are a metric on the torus, so the decomposition is one there
/// too, without a pair for each image. Sums that need one displacement for all points of a pair go on below
/// those pairs that do not have `has_one_image`.
///
/// O(s^3 n) pairs for n points while their number is below n^2 / 2, which is the most that there can be.
/// @throws InvalidParameter unless s is positive and finite.
WellSeparatedPairs well_separated_pairs(const PointTree& tree, double s);

}  // namespace dch
#pragma GCC visibility pop
