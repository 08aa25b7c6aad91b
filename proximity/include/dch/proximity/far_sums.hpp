// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/proximity/point_tree.hpp>

#pragma GCC visibility push(default)
namespace dch {

struct FarSumParams {
  /// Of the error at a point, relative to the sum of |q_j| K(r_ij) there: 1e-12 to below 1.
  double tolerance = 1e-4;
  /// Inverse screening length of K(r) = exp(-kappa r) / r; 0 for 1 / r [1/length].
  double kappa = 0;
  /// Threads; null for that of the caller alone. Not owned; results do not depend on it.
  Executor* executor = nullptr;
};

struct FarSums {
  std::vector<double> potentials;  ///< by id; 0 for an id that there is not [charge / length]
  /// No potential is farther off, relative to the sum of |q_j| K(r_ij) at its point: proven, beside rounding.
  /// At most the tolerance; 0 if every pair was summed directly, without a periodic box.
  double error_bound = 0;
  int order = 0;                ///< degree up to which expansions go
  int images = 1;               ///< of all charges that were summed over; 1 without a periodic box
  std::int64_t far_pairs = 0;   ///< pairs of nodes that were summed by expansions
  std::int64_t near_pairs = 0;  ///< pairs of a point and a charge that were summed directly
  std::int64_t looked_at = 0;   ///< pairs of nodes that were compared
};

/// Potentials of charges at all points of a tree: the sum over j of q_j K(r_ij), by well-separated pairs of
/// nodes (thesis 5.6.4) with multipole and local expansions. O(n) for points of bounded density.
///
/// A pair of nodes is taken as one where the proven error of expansions of the order used is small beside the
/// potential; that order follows from the tolerance alone. Sums of both signs have the same guarantee, which
/// is relative to the sum over |q_j|, since they may cancel.
///
/// A point exerts nothing on itself, nor on points that coincide with it: pairs nearer than 1e-140 of the
/// extent of the points are left out, and in periodic boxes those no farther apart than tree.rounding().
///
/// Charges so far away that exp(-kappa r) is below 1e-300 may count as if it were 1e-307.
///
/// In a periodic box the sum is over all images of all charges, the point's own ones included. Only the
/// screened kernel has one. So many images are summed over that the rest is below a hundredth of the
/// tolerance.
///
/// @param charges by id, as many as tree.capacity(); those of ids that there are not are ignored
/// @throws InvalidParameter for another number of charges or one that is not finite, a tolerance or kappa out
///   of range, kappa = 0 in a periodic box, and for a kappa so small that more than 100,000 images count.
FarSums far_sums(const PointTree& tree, Span<const double> charges, const FarSumParams& params);

}  // namespace dch
#pragma GCC visibility pop
