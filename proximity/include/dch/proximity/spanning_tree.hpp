// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// An edge between two points, the smaller id first.
struct TreeEdge {
  std::int32_t a = -1, b = -1;
  double distance2 = 0;  ///< squared distance of nearest images [length^2]

  /// Shorter ones first; of edges equally long, by ids: a total order, so that the tree is unique.
  friend bool operator<(const TreeEdge& x, const TreeEdge& y) {
    if (x.distance2 != y.distance2) return x.distance2 < y.distance2;
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  }
};

/// The Euclidean minimum spanning tree of a hierarchy's points, in every box (on the torus: by nearest
/// images). Its edges up to a length join what a neighbor list of that cutoff joins, so it holds the clusters
/// at every cutoff: single linkage.
struct SpanningTree {
  std::vector<std::int32_t> points;  ///< ids, ascending
  std::vector<TreeEdge> edges;       ///< one fewer than points, ascending
};

/// Boruvka's algorithm: the shortest edge that leaves a component comes from the nearest neighbors of its
/// points, or, where these are all in the component, from a descent that leaves out subtrees of the
/// component. The same tree on any number of threads.
/// @param executor threads to search nearest neighbors with; null for that of the caller alone
SpanningTree minimum_spanning_tree(const HierarchyView& view, Executor* executor = nullptr);

/// Single linkage: which points are joined by a chain of others with no step longer than a cutoff.
struct Clusters {
  std::vector<std::int32_t> label;  ///< by place in SpanningTree::points: the smallest id of its cluster
  std::vector<std::int64_t> sizes;  ///< of all clusters, descending
};

/// The clusters at a cutoff [length]. O(points).
/// @throws InvalidParameter for a negative cutoff or NaN.
Clusters clusters_at(const SpanningTree& tree, double cutoff);

/// How many clusters there are at each of some cutoffs [length]. O(lg points) each.
/// @throws as clusters_at().
std::vector<std::int64_t> cluster_counts(const SpanningTree& tree, Span<const double> cutoffs);

}  // namespace dch
#pragma GCC visibility pop
