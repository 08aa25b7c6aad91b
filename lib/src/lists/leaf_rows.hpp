// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "leaves/leaf_source.hpp"
#include "lists/leaf_candidates.hpp"
#include "lists/row_parts.hpp"

namespace dch::detail {

/// What lists are made of, the same for all of them.
struct ListScene {
  const Box& box;
  /// Hierarchies, that of the smallest cutoffs first. The rows of one hold its pairs with those before it.
  Span<LeafSource* const> sources;
  /// Largest list radius of the points of two sources, row-major, at most half the box where there is more
  /// than one source [length].
  std::vector<double> reach;
  double error;  ///< how far the distance of two positions may be from their pair distance [length]
  Executor* executor;

  double reach_of(std::size_t a, std::size_t b) const { return reach[a * sources.size() + b]; }
};

/// Writes neighbor lists from leaves that the conflict graph joins: the level-0 edges, enumerated
/// among the children of equal or neighboring level-1 nodes (Lemma 5.3.1(5)).
///
/// Points are held relative to the center of their leaf, as 16-bit integers: a test of 32 pairs is a few
/// instructions, and its precision does not depend on the box. What such a test leaves open, a band of about
/// a thousandth of the cutoff, is decided by the pair distance in double. The integer arithmetic is the same
/// on every instruction set, so the rows are too; and they do not depend on the number of threads.
class LeafRows {
 public:
  /// Finds all pairs that each filter accepts, as unsorted half lists, ghosts having rows like
  /// all others. What the filters' cutoffs depend on must be the same for all, and the first one's list
  /// radius the largest. Edges must join all leaves of a source with points within its reach of each other.
  void find(const ListScene& scene, const std::vector<const PairFilter*>& filters,
            const std::vector<NeighborList*>& out);
  /// Of all searches so far, with the present number of threads.
  ListWork work() const { return parts_.work(); }
  std::size_t memory_bytes() const { return parts_.memory_bytes(); }

 private:
  template <class Metric>
  void find_with(const Metric& metric, const ListScene& scene, const std::vector<const PairFilter*>& filters,
                 const std::vector<NeighborList*>& out);
  template <class Metric>
  void find_rows(const LeafScene<Metric>& scene, Executor* executor, const std::vector<NeighborList*>& out);
  template <class Metric>
  static void find_by_distance(const Metric& metric, const LeafSource& source, const PairFilter& filter,
                               NeighborList& out);

  RowParts<LeafCandidates> parts_;
};

}  // namespace dch::detail
