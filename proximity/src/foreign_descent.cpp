// SPDX-License-Identifier: MIT
#include "foreign_descent.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/metric.hpp"
#include "geometry/position_check.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {

template <class Metric>
ForeignDescent<Metric>::ForeignDescent(const Metric& metric, const Structure& structure,
                                       const SubtreeBalls& balls)
    : metric_(metric),
      structure_(structure),
      balls_(balls),
      slack_(WrapError(structure.box).bound(structure.largest_reach)),
      of_node_(structure.levels.size()) {}

template <class Metric>
void ForeignDescent<Metric>::label(const std::vector<std::int32_t>& component) {
  component_ = &component;
  for (int level = 1; level <= structure_.top(); ++level) {
    const Level& nodes = structure_.levels[level];
    of_node_[level].assign(static_cast<std::size_t>(nodes.size()), kNone);
    for (std::int32_t k = 0; k < nodes.size(); ++k) {
      if (!nodes.is_alive(k)) continue;
      std::int32_t& all = of_node_[level][k];
      const auto add = [&](std::int32_t one) { all = all == kNone || all == one ? one : kMixed; };
      if (structure_.is_singleton(level, k)) add(component[nodes.id[k]]);
      structure_.for_each_child(level, k, [&](std::int32_t child) {
        add(level == 1 ? component[structure_.points.id[child]] : of_node_[level - 1][child]);
      });
    }
  }
}

/// How far off a point may be at most, by its wrapped image.
template <class Metric>
double ForeignDescent<Metric>::limit(const TreeEdge& best) const {
  return (std::sqrt(best.distance2) + slack_) * kInflate;
}

template <class Metric>
void ForeignDescent<Metric>::search(std::int32_t id, TreeEdge& best) {
  id_ = id;
  at_ = metric_.wrap(structure_.raw[id]);
  waiting_.clear();
  const Level& top = structure_.levels.back();
  for (std::int32_t root = 0; root < top.size(); ++root)
    if (top.is_alive(root)) push(structure_.top(), root, best);
  while (!waiting_.empty()) {
    std::pop_heap(waiting_.begin(), waiting_.end());
    const Subtree nearest = waiting_.back();
    waiting_.pop_back();
    if (nearest.distance > limit(best)) return;
    if (nearest.level == 1) {
      look_at_leaf(nearest.node, best);
      continue;
    }
    if (structure_.is_singleton(nearest.level, nearest.node))
      look_at_point(structure_.levels[nearest.level].id[nearest.node], best);
    structure_.for_each_child(nearest.level, nearest.node,
                              [&](std::int32_t child) { push(nearest.level - 1, child, best); });
  }
}

template <class Metric>
void ForeignDescent<Metric>::push(int level, std::int32_t node, const TreeEdge& best) {
  if (of_node_[level][node] == (*component_)[id_]) return;
  const double apart = std::sqrt(metric_.distance2(at_, structure_.position(level, node)));
  const double distance = apart - balls_.radius(level, node) * kInflate;
  if (distance > limit(best)) return;
  waiting_.push_back({std::max(0.0, distance), level, node});
  std::push_heap(waiting_.begin(), waiting_.end());
}

template <class Metric>
void ForeignDescent<Metric>::look_at_leaf(std::int32_t node, TreeEdge& best) {
  structure_.for_each_child(1, node, [&](std::int32_t slot) {
    const double far = limit(best);
    if (metric_.distance2(at_, structure_.points.position[slot]) <= far * far)
      look_at_point(structure_.points.id[slot], best);
  });
}

template <class Metric>
void ForeignDescent<Metric>::look_at_point(std::int32_t id, TreeEdge& best) {
  if ((*component_)[id] == (*component_)[id_]) return;
  const TreeEdge edge{std::min(id, id_), std::max(id, id_),
                      structure_.box.distance2(structure_.raw[id_], structure_.raw[id])};
  if (edge < best) best = edge;
}

template class ForeignDescent<OpenMetric>;
template class ForeignDescent<OrthorhombicMetric>;
template class ForeignDescent<LatticeMetric>;

}  // namespace dch::detail
