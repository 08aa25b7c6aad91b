// SPDX-License-Identifier: MIT
#include "nearest_descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/metric.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

/// Offsets and corners of blocks are rounded to float: by less than this share of the extent of their leaf.
constexpr double kFloatError = 0x1p-23;

/// Squared distance of a point from a block's box, both relative to the center of a leaf.
double gap2_between(Vec3 at, const MeasuredLeaves::Corners& corners) {
  Vec3 gap;
  for (int axis = 0; axis < 3; ++axis)
    gap[axis] = std::max({double{corners.low[axis]} - at[axis], at[axis] - double{corners.high[axis]}, 0.0});
  return norm2(gap);
}

}  // namespace

template <class Metric>
void NearestDescent<Metric>::search(Vec3 position, std::int32_t self, double epsilon,
                                    NearestCandidates& best) {
  const double reach = std::max(structure_.largest_reach, wrap_error_.reach(position));
  Query query{position, metric_.wrap(position),
              self,     wrap_error_.bound(reach),
              &best,    std::numeric_limits<double>::infinity()};
  waiting_.clear();
  const Level& top = structure_.levels.back();
  for (std::int32_t root = 0; root < top.size(); ++root)
    if (top.is_alive(root)) push(query, structure_.top(), root);
  while (!waiting_.empty()) {
    std::pop_heap(waiting_.begin(), waiting_.end());
    const Subtree nearest = waiting_.back();
    waiting_.pop_back();
    if (nearest.distance * (1 + epsilon) > query.limit) return;
    open(query, nearest);
  }
}

template <class Metric>
void NearestDescent<Metric>::push(const Query& query, int level, std::int32_t node) {
  ++work.nodes;
  const double apart = std::sqrt(metric_.distance2(query.wrapped, structure_.position(level, node)));
  const double distance = apart - balls_.radius(level, node) * kInflate;
  if (distance > query.limit) return;
  waiting_.push_back({std::max(0.0, distance), level, node});
  std::push_heap(waiting_.begin(), waiting_.end());
}

template <class Metric>
void NearestDescent<Metric>::open(Query& query, const Subtree& subtree) {
  if (subtree.level == 1) return look_at_leaf(query, subtree.node);
  if (structure_.is_singleton(subtree.level, subtree.node))
    look_at_point(query, structure_.levels[subtree.level].id[subtree.node]);
  structure_.for_each_child(subtree.level, subtree.node,
                            [&](std::int32_t child) { push(query, subtree.level - 1, child); });
}

/// The box of a block says how near its points are where no other image of it can be as near.
template <class Metric>
void NearestDescent<Metric>::look_at_leaf(Query& query, std::int32_t node) {
  const MeasuredLeaves::Leaf& leaf = structure_.leaves.leaves[node];
  const Vec3 at = metric_.displacement(structure_.levels[1].position[node], query.wrapped);
  const double rounding = kFloatError * leaf.extent;
  for (std::int32_t b = leaf.first_block; b < leaf.first_block + leaf.blocks; ++b) {
    ++work.blocks;
    const double within = query.limit + rounding;
    const bool has_one_image = (within + leaf.extent) * kInflate < structure_.box.max_cutoff();
    if (has_one_image && gap2_between(at, structure_.leaves.corners[b]) > within * within) continue;
    const std::int32_t first = structure_.leaves.source[b] * kBlock;
    for (std::int32_t slot = first; slot < first + structure_.leaves.count[b]; ++slot) {
      ++work.points;
      if (metric_.distance2(query.wrapped, structure_.points.position[slot]) <= query.limit * query.limit)
        look_at_point(query, structure_.points.id[slot]);
    }
  }
}

template <class Metric>
void NearestDescent<Metric>::look_at_point(Query& query, std::int32_t id) {
  if (id == query.self) return;
  query.best->add(structure_.box.distance2(query.given, structure_.raw[id]), id);
  query.limit = (std::sqrt(query.best->limit2()) + query.slack) * kInflate;
}

template class NearestDescent<OpenMetric>;
template class NearestDescent<OrthorhombicMetric>;
template class NearestDescent<LatticeMetric>;

}  // namespace dch::detail
