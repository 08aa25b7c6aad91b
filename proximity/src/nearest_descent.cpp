// SPDX-License-Identifier: MIT
#include "nearest_descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "geometry/metric.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

constexpr std::ptrdiff_t kDivers = 3;  ///< subtrees of a level

}  // namespace

template <class Metric, class Candidates>
void NearestDescent<Metric, Candidates>::search(Vec3 position, std::int32_t self, double epsilon,
                                                Candidates& best) {
  const double reach = std::max(structure_.largest_reach, wrap_error_.reach(position));
  Query query{position, metric_.wrap(position), self, wrap_error_.bound(reach), &best, 0, 1 / (1 + epsilon)};
  set_limit(query);
  push_roots(query);
  if (query.limit == std::numeric_limits<double>::infinity()) dive(query);
  while (!waiting_.empty()) {
    const Subtree next = waiting_.back();
    waiting_.pop_back();
    if (!is_too_far(query, next)) open(query, next);
  }
}

template <class Metric, class Candidates>
void NearestDescent<Metric, Candidates>::push_roots(const Query& query) {
  waiting_.clear();
  const Level& top = structure_.levels.back();
  for (std::int32_t root = 0; root < top.size(); ++root)
    if (top.is_alive(root)) push(query, structure_.top(), root);
}

/// Down to the leaves with a few nodes of each level, so that the first leaf to be looked at is a near one.
/// Where there is a limit from the start, that is not needed.
template <class Metric, class Candidates>
void NearestDescent<Metric, Candidates>::dive(Query& query) {
  std::size_t first = 0;  // of this level
  for (int level = structure_.top(); level > 1; --level) {
    const auto begin = waiting_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = begin + std::min(kDivers, waiting_.end() - begin);
    std::partial_sort(begin, end, waiting_.end(), is_nearer);
    divers_.assign(begin, end);
    waiting_.erase(begin, end);
    first = waiting_.size();
    for (const Subtree& next : divers_) open(query, next);
  }
  put_nearest_last(first);
}

template <class Metric, class Candidates>
bool NearestDescent<Metric, Candidates>::is_too_far(const Query& query, const Subtree& subtree) const {
  const double within = (query.limit * query.shrink + subtree.radius) * kInflate;
  return subtree.distance2 > within * within;
}

template <class Metric, class Candidates>
void NearestDescent<Metric, Candidates>::push(const Query& query, int level, std::int32_t node) {
  ++work.nodes;
  const Subtree subtree{metric_.distance2(query.wrapped, structure_.position(level, node)),
                        balls_.radius(level, node), level, node};
  if (!is_too_far(query, subtree)) waiting_.push_back(subtree);
}

template <class Metric, class Candidates>
void NearestDescent<Metric, Candidates>::put_nearest_last(std::size_t first) {
  if (first == waiting_.size()) return;
  const auto begin = waiting_.begin() + static_cast<std::ptrdiff_t>(first);
  std::iter_swap(std::min_element(begin, waiting_.end(), is_nearer), waiting_.end() - 1);
}

template <class Metric, class Candidates>
void NearestDescent<Metric, Candidates>::open(Query& query, const Subtree& subtree) {
  if (subtree.level == 1) return look_at_leaf(query, subtree.node);
  if (structure_.is_singleton(subtree.level, subtree.node)) {
    const std::int32_t id = structure_.levels[subtree.level].id[subtree.node];
    look_at_point(query, id, structure_.raw[id]);
  }
  const std::size_t first = waiting_.size();
  structure_.for_each_child(subtree.level, subtree.node,
                            [&](std::int32_t child) { push(query, subtree.level - 1, child); });
  put_nearest_last(first);
}

/// The nearest block comes first: after it hardly another one is near enough.
template <class Metric, class Candidates>
void NearestDescent<Metric, Candidates>::look_at_leaf(Query& query, std::int32_t node) {
  const Vec3 at = metric_.displacement(structure_.levels[1].position[node], query.wrapped);
  const double extent = balls_.radius(1, node);
  // The box says how near the points are where no other image of it can be as near.
  const auto most_gap2 = [&] {
    const bool has_one_image = (query.limit + extent) * kInflate < structure_.box.max_cutoff();
    return has_one_image ? BlockBoxes::most_gap2(at, extent, query.limit)
                         : std::numeric_limits<float>::infinity();
  };
  near_blocks_.clear();
  std::size_t nearest = 0;
  work.blocks += balls_.boxes().for_each_within(node, at, most_gap2(), [&](std::int32_t block, float gap2) {
    near_blocks_.push_back({gap2, block});
    if (gap2 < near_blocks_[nearest].gap2) nearest = near_blocks_.size() - 1;
  });
  if (near_blocks_.empty()) return;
  std::swap(near_blocks_[0], near_blocks_[nearest]);
  for (const NearBlock& block : near_blocks_)
    if (!(block.gap2 > most_gap2())) look_at_block(query, block.block);
}

template <class Metric, class Candidates>
void NearestDescent<Metric, Candidates>::look_at_block(Query& query, std::int32_t block) {
  const LeafBlocks& points = structure_.points;
  const std::int32_t first = block * kBlock, last = first + points.count[block];
  work.points += points.count[block];
  for (std::int32_t slot = first; slot < last; ++slot) {
    if (metric_.distance2(query.wrapped, points.position[slot]) > query.limit * query.limit) continue;
    // In an open box the point is in its slot as it was given.
    constexpr bool kIsGiven = std::is_same_v<Metric, OpenMetric>;
    const std::int32_t id = points.id[slot];
    look_at_point(query, id, kIsGiven ? points.position[slot] : structure_.raw[id]);
  }
}

template <class Metric, class Candidates>
void NearestDescent<Metric, Candidates>::look_at_point(Query& query, std::int32_t id, Vec3 given) {
  if (id == query.self) return;
  query.best->add(structure_.box.distance2(query.given, given), id);
  set_limit(query);
}

template <class Metric, class Candidates>
void NearestDescent<Metric, Candidates>::set_limit(Query& query) {
  query.limit = (std::sqrt(query.best->limit2()) + query.slack) * kInflate;
}

template class NearestDescent<OpenMetric, NearestCandidates>;
template class NearestDescent<OrthorhombicMetric, NearestCandidates>;
template class NearestDescent<LatticeMetric, NearestCandidates>;
template class NearestDescent<OpenMetric, WithinCandidates>;
template class NearestDescent<OrthorhombicMetric, WithinCandidates>;
template class NearestDescent<LatticeMetric, WithinCandidates>;
template class NearestDescent<OpenMetric, ClosestCandidate>;
template class NearestDescent<OrthorhombicMetric, ClosestCandidate>;
template class NearestDescent<LatticeMetric, ClosestCandidate>;

}  // namespace dch::detail
