// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include <dch/base/error.hpp>
#include <dch/proximity/nearest.hpp>
#include <dch/proximity/spanning_tree.hpp>

#include "base/describe.hpp"
#include "components.hpp"
#include "foreign_descent.hpp"
#include "geometry/metric.hpp"
#include "hierarchy/subtree_balls.hpp"

namespace dch {
namespace {

/// Neighbors that are looked up for each point at first. With more, fewer points have none of another
/// component among them later.
constexpr std::int32_t kNeighbors = 8;

/// The tree as it grows.
template <class Metric>
class Boruvka {
 public:
  Boruvka(const Metric& metric, const detail::Structure& structure, const NearestRows& rows)
      : structure_(structure),
        rows_(rows),
        measured_(structure.balls ? std::nullopt : std::optional<detail::SubtreeBalls>(structure)),
        descent_(metric, structure, measured_ ? *measured_ : *structure.balls),
        components_(structure.slot_of_id.size()),
        next_(structure.slot_of_id.size(), 0) {}

  std::vector<TreeEdge> edges(const std::vector<std::int32_t>& points) {
    std::vector<TreeEdge> edges;
    while (edges.size() + 1 < points.size()) {
      label();
      best_.assign(component_.size(), kNoEdge);
      for (const std::int32_t id : points) look_at_row(id);
      for (const std::int32_t id : points) look_farther(id);
      for (const TreeEdge& edge : best_)
        if (edge.a >= 0 && components_.join(edge.a, edge.b)) edges.push_back(edge);
    }
    std::sort(edges.begin(), edges.end());
    return edges;
  }

 private:
  static constexpr TreeEdge kNoEdge{-1, -1, std::numeric_limits<double>::infinity()};

  void label() {
    component_.resize(next_.size());
    for (std::size_t id = 0; id < next_.size(); ++id)
      component_[id] = components_.of(static_cast<std::int32_t>(id));
    descent_.label(component_);
  }
  /// The first neighbor in a row that is in another component; entries before it never are again.
  void look_at_row(std::int32_t id) {
    const Span<const std::int32_t> row = rows_.row(static_cast<std::size_t>(id));
    std::int32_t& next = next_[id];
    while (next < rows_.k && row[next] >= 0 && component_[row[next]] == component_[id]) ++next;
    if (next == rows_.k || row[next] < 0) return;
    const std::int32_t other = row[next];
    const TreeEdge edge{std::min(id, other), std::max(id, other), distance2(id, next)};
    TreeEdge& best = best_[component_[id]];
    if (edge < best) best = edge;
  }
  /// Points whose row ends before a longer edge than the best one would come ask by descent.
  void look_farther(std::int32_t id) {
    TreeEdge& best = best_[component_[id]];
    if (next_[id] < rows_.k || distance2(id, rows_.k - 1) > best.distance2) return;
    descent_.search(id, best);
  }
  double distance2(std::int32_t id, std::int32_t place) const {
    return rows_.distance2[static_cast<std::size_t>(id) * static_cast<std::size_t>(rows_.k) +
                           static_cast<std::size_t>(place)];
  }

  const detail::Structure& structure_;
  const NearestRows& rows_;
  std::optional<detail::SubtreeBalls> measured_;  ///< unless the hierarchy keeps them up
  detail::ForeignDescent<Metric> descent_;
  detail::Components components_;
  std::vector<std::int32_t> next_;       ///< by id: place in its row
  std::vector<std::int32_t> component_;  ///< by id
  std::vector<TreeEdge> best_;           ///< by component: the first edge that leaves it
};

void check_cutoff(double cutoff) {
  if (!(cutoff >= 0))
    throw InvalidParameter("the cutoff of clusters is " + detail::describe(cutoff) +
                           "; it must be 0 or more");
}

/// How many edges of a tree are no longer than a cutoff.
std::size_t edges_within(const SpanningTree& tree, double cutoff) {
  check_cutoff(cutoff);
  const auto end = std::partition_point(tree.edges.begin(), tree.edges.end(), [=](const TreeEdge& edge) {
    return edge.distance2 <= cutoff * cutoff;
  });
  return static_cast<std::size_t>(end - tree.edges.begin());
}

}  // namespace

SpanningTree minimum_spanning_tree(const HierarchyView& view, Executor* executor) {
  SpanningTree tree;
  for (std::size_t id = 0; id < view.capacity(); ++id)
    if (view.contains(static_cast<std::int32_t>(id))) tree.points.push_back(static_cast<std::int32_t>(id));
  if (tree.points.size() < 2) return tree;
  NearestParams params;
  params.k = kNeighbors;
  params.executor = executor;
  const NearestRows rows = Nearest(view).of_points(params);
  const detail::Structure& structure = view.structure();
  tree.edges = detail::with_metric(structure.box, [&](const auto& metric) {
    return Boruvka<std::decay_t<decltype(metric)>>(metric, structure, rows).edges(tree.points);
  });
  return tree;
}

Clusters clusters_at(const SpanningTree& tree, double cutoff) {
  const std::size_t joined = edges_within(tree, cutoff);
  const std::size_t ids = tree.points.empty() ? 0 : static_cast<std::size_t>(tree.points.back()) + 1;
  detail::Components components(ids);
  for (std::size_t e = 0; e < joined; ++e) components.join(tree.edges[e].a, tree.edges[e].b);
  Clusters clusters;
  std::vector<std::int64_t> size(ids, 0);
  for (const std::int32_t id : tree.points) {
    clusters.label.push_back(components.of(id));
    ++size[clusters.label.back()];
  }
  std::copy_if(size.begin(), size.end(), std::back_inserter(clusters.sizes),
               [](std::int64_t n) { return n > 0; });
  std::sort(clusters.sizes.begin(), clusters.sizes.end(), std::greater<>());
  return clusters;
}

std::vector<std::int64_t> cluster_counts(const SpanningTree& tree, Span<const double> cutoffs) {
  std::vector<std::int64_t> counts;
  for (const double cutoff : cutoffs)
    counts.push_back(static_cast<std::int64_t>(tree.points.size() - edges_within(tree, cutoff)));
  return counts;
}

}  // namespace dch
