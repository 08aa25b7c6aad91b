// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/proximity/point_tree.hpp>
#include <dch/proximity/spanning_tree.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// A path along the edges of a spanner.
struct SpannerPath {
  std::vector<std::int32_t> points;  ///< ids from the first to the last
  double length = 0;                 ///< [length]
};

/// A graph on the points of a tree with a path between any two that is at most 1 + epsilon times as long as
/// their distance (thesis 5.6.1, from well-separated pairs in place of the conflict graph): an edge between
/// the representatives of the two nodes of each pair. Distances are those of nearest images.
///
/// The nodes of a pair are separated as the proof needs, in terms of how far points really are from their
/// representatives: a third of the pairs that s = 4 + 8 / epsilon takes. Lengths hold up to rounding, which
/// is PointTree::rounding() a step. Good until the tree is updated.
class Spanner {
 public:
  /// @param epsilon positive; O(n / epsilon^3) edges for n points while that is below n^2 / 2.
  /// @throws InvalidParameter unless epsilon is positive and finite.
  Spanner(const PointTree& tree, double epsilon);
  Spanner(PointTree&&, double) = delete;  ///< the tree has to stay

  double epsilon() const { return epsilon_; }
  /// By ids; each once.
  const std::vector<TreeEdge>& edges() const { return edges_; }
  double weight() const;            ///< sum of the lengths of all edges [length]
  std::int64_t max_degree() const;  ///< most edges of a point
  /// The points joined to a point by an edge; none of an id without a point.
  Span<const std::int32_t> neighbors(std::int32_t id) const;

  /// A shortest path along edges, by Dijkstra's algorithm: O(m + n lg n) for m edges.
  /// @throws InvalidParameter if there is no such point.
  SpannerPath shortest_path(std::int32_t from, std::int32_t to) const;
  /// Lengths of shortest paths from a point, by id; infinity where there is no point [length].
  /// @throws InvalidParameter if there is no such point.
  std::vector<double> path_lengths(std::int32_t from) const;
  /// Largest ratio of path to distance over all pairs of points that do not coincide; 1 if there are none.
  /// O(n (m + n lg n)), for tests and small sets.
  double stretch() const;

 private:
  struct Reached;
  void check_point(std::int32_t id) const;
  Reached search(std::int32_t from, std::int32_t to) const;

  const PointTree* tree_;
  double epsilon_;
  std::vector<TreeEdge> edges_;
  std::vector<std::int64_t> first_;     ///< by id: where its neighbors begin
  std::vector<std::int32_t> neighbor_;  ///< in both directions
};

}  // namespace dch
#pragma GCC visibility pop
