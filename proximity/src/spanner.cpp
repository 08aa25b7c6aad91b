// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/proximity/spanner.hpp>

#include "base/describe.hpp"
#include "dual_descent.hpp"
#include "gap_between.hpp"
#include "geometry/tolerance.hpp"

namespace dch {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Edges between the representatives a and b of pairs of nodes A and B whose points are all at least
/// (1 + 2 / epsilon) (r_A + r_B) apart, where r_A is how far a point of A is from a at most.
///
/// Then paths are at most t = 1 + epsilon times as long as distances. Take points p and q, below A and B of
/// the pair that covers them, and let shorter distances have such paths already. p and a are nearer to each
/// other than p and q, and so are q and b. Over a and b there is a path of length at most
/// t r_A + |ab| + t r_B <= |pq| + (t + 1) (r_A + r_B), and (t + 1) (r_A + r_B) = (2 + epsilon) (r_A + r_B) <=
/// epsilon |pq|. Where r_A = r_B = 0, the points below A coincide with a, and edges of length 0 join them, by
/// induction over the nodes below A.
///
/// With balls of radius r around both nodes and any points as representatives, r_A <= 2 r, this would be
/// s = 4 + 8 / epsilon.
std::vector<TreeEdge> edges_between_representatives(const PointTree& tree, double epsilon) {
  const auto is_separated = [&](const PointTree::Node& a, const PointTree::Node& b) {
    if (a.reach + b.reach == 0) return true;
    const double reach = a.reach + b.reach + 2 * tree.rounding(), least = (1 + 2 / epsilon) * reach;
    const double between = std::sqrt(tree.distance2(a.representative, b.representative));
    return between / detail::kInflate - reach >= least || detail::gap_between(tree, a, b) >= least;
  };
  std::vector<TreeEdge> edges;
  detail::for_each_separated_pair(tree, is_separated, [&](std::int32_t x, std::int32_t y) {
    const auto [a, b] = std::minmax(tree.node(x).representative, tree.node(y).representative);
    edges.push_back({a, b, tree.distance2(a, b)});
  });
  // A point may represent several nodes.
  const auto ids = [](const TreeEdge& edge) { return std::pair(edge.a, edge.b); };
  std::sort(edges.begin(), edges.end(),
            [&](const TreeEdge& e, const TreeEdge& f) { return ids(e) < ids(f); });
  edges.erase(std::unique(edges.begin(), edges.end(),
                          [&](const TreeEdge& e, const TreeEdge& f) { return ids(e) == ids(f); }),
              edges.end());
  return edges;
}

void check_epsilon(double epsilon) {
  if (!(std::isfinite(epsilon) && epsilon > 0))
    throw InvalidParameter("epsilon of a spanner is " + detail::describe(epsilon) +
                           "; it must be positive and finite: paths are up to 1 + epsilon times as long as "
                           "distances");
}

}  // namespace

Spanner::Spanner(const PointTree& tree, double epsilon) : tree_(&tree), epsilon_(epsilon) {
  check_epsilon(epsilon);
  edges_ = edges_between_representatives(tree, epsilon);
  std::size_t ids = 0;
  for (const std::int32_t id : tree.ids()) ids = std::max(ids, static_cast<std::size_t>(id) + 1);
  first_.assign(ids + 1, 0);
  for (const TreeEdge& edge : edges_) {
    ++first_[static_cast<std::size_t>(edge.a) + 1];
    ++first_[static_cast<std::size_t>(edge.b) + 1];
  }
  for (std::size_t id = 0; id < ids; ++id) first_[id + 1] += first_[id];
  neighbor_.resize(2 * edges_.size());
  std::vector<std::int64_t> next = first_;
  const auto put = [&](std::int32_t id, std::int32_t other) {
    neighbor_[static_cast<std::size_t>(next[static_cast<std::size_t>(id)]++)] = other;
  };
  for (const TreeEdge& edge : edges_) {
    put(edge.a, edge.b);
    put(edge.b, edge.a);
  }
}

double Spanner::weight() const {
  double sum = 0;
  for (const TreeEdge& edge : edges_) sum += std::sqrt(edge.distance2);
  return sum;
}

std::int64_t Spanner::max_degree() const {
  std::int64_t most = 0;
  for (std::size_t id = 0; id + 1 < first_.size(); ++id) most = std::max(most, first_[id + 1] - first_[id]);
  return most;
}

Span<const std::int32_t> Spanner::neighbors(std::int32_t id) const {
  if (!tree_->contains(id)) return {};
  const auto k = static_cast<std::size_t>(id);
  return {neighbor_.data() + first_[k], static_cast<std::size_t>(first_[k + 1] - first_[k])};
}

/// Shortest paths from a point, as far as the search got.
struct Spanner::Reached {
  std::vector<double> length;          ///< by id; final for points that were left
  std::vector<std::int32_t> previous;  ///< by id: the point before it on its path
};

void Spanner::check_point(std::int32_t id) const {
  if (!tree_->contains(id))
    throw InvalidParameter("a path in a spanner was asked for from or to " + std::to_string(id) +
                           ", and there is no point with that id; take one of those of the tree");
}

/// Dijkstra's algorithm, until the shortest path to a point is known.
/// @param to -1 for all points
Spanner::Reached Spanner::search(std::int32_t from, std::int32_t to) const {
  check_point(from);
  Reached reached{std::vector<double>(first_.size() - 1, kFar),
                  std::vector<std::int32_t>(first_.size() - 1, -1)};
  using Entry = std::pair<double, std::int32_t>;
  std::vector<Entry> waiting{{0, from}};
  reached.length[static_cast<std::size_t>(from)] = 0;
  while (!waiting.empty()) {
    std::pop_heap(waiting.begin(), waiting.end(), std::greater<>());
    const auto [length, at] = waiting.back();
    waiting.pop_back();
    if (at == to) return reached;
    if (length > reached.length[static_cast<std::size_t>(at)]) continue;
    for (const std::int32_t next : neighbors(at)) {
      const double through = length + std::sqrt(tree_->distance2(at, next));
      if (through >= reached.length[static_cast<std::size_t>(next)]) continue;
      reached.length[static_cast<std::size_t>(next)] = through;
      reached.previous[static_cast<std::size_t>(next)] = at;
      waiting.emplace_back(through, next);
      std::push_heap(waiting.begin(), waiting.end(), std::greater<>());
    }
  }
  return reached;
}

SpannerPath Spanner::shortest_path(std::int32_t from, std::int32_t to) const {
  check_point(to);
  const Reached reached = search(from, to);
  SpannerPath path;
  path.length = reached.length[static_cast<std::size_t>(to)];
  for (std::int32_t at = to; at >= 0; at = reached.previous[static_cast<std::size_t>(at)])
    path.points.push_back(at);
  std::reverse(path.points.begin(), path.points.end());
  return path;
}

std::vector<double> Spanner::path_lengths(std::int32_t from) const { return search(from, -1).length; }

double Spanner::stretch() const {
  double most = 1;
  for (const std::int32_t from : tree_->ids()) {
    const std::vector<double> length = path_lengths(from);
    for (const std::int32_t to : tree_->ids()) {
      const double distance = std::sqrt(tree_->distance2(from, to));
      if (distance > 0) most = std::max(most, length[static_cast<std::size_t>(to)] / distance);
    }
  }
  return most;
}

}  // namespace dch
