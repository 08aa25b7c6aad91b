// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/box.hpp>
#include <dch/executor.hpp>
#include <dch/neighbor_list.hpp>

#include "cluster_points.hpp"
#include "hierarchy_level.hpp"
#include "pair_filter.hpp"
#include "point_blocks.hpp"
#include "row_finder.hpp"

namespace dch::detail {

/// Writes neighbor lists from clusters of points that the conflict graph joins: the level-0 edges, enumerated
/// among the children of equal or neighboring level-1 nodes (Lemma 5.3.1(5)).
///
/// Points are held relative to the center of their cluster, as 16-bit integers: a test of 32 pairs is a few
/// instructions, and its precision does not depend on the box. What such a test leaves open, a band of about
/// a thousandth of the cutoff, is decided by the pair distance in double. The integer arithmetic is the same
/// on every instruction set, so the rows are too; and they do not depend on the number of threads.
class ClusterRows {
 public:
  /// Takes the positions of the points relative to their cluster's center. To be called again when a point
  /// has moved, come or gone.
  template <class Metric>
  void measure(const Metric& metric, const Level& clusters, PointBlocks& points, double covered2,
               Executor* executor) {
    points_.measure(metric, clusters, points, covered2, executor);
  }
  ClusterPoints& points() { return points_; }
  const ClusterPoints& points() const { return points_; }

  /// Finds all pairs that the filter accepts, as a half list ordered by structure, ghosts having rows like
  /// all others. Edges must join all clusters with points within the square root of
  /// filter.largest_distance2().
  template <class Metric>
  void find(const Metric& metric, const Box& box, const Level& clusters, const PointBlocks& blocks,
            Span<const std::int32_t> slot_of_id, std::int32_t first_ghost, double error,
            const PairFilter& filter, Executor* executor, NeighborList& out);
  std::size_t memory_bytes() const;

 private:
  template <class Metric>
  void find_side_by_side(const RowFinder::Scene<Metric>& scene, Executor& executor, NeighborList& out);
  template <class Metric>
  static void find_by_distance(const Metric& metric, const Level& clusters, const PointBlocks& points,
                               const PairFilter& filter, NeighborList& out);

  ClusterPoints points_;
  std::vector<RowFinder> finders_;    ///< one a part of the work
  std::vector<NeighborList> pieces_;  ///< what they found, where there is more than one
};

}  // namespace dch::detail
