// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include <dch/base/error.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>

#include "geometry/metric.hpp"
#include "hierarchy/structure.hpp"

namespace dch {

using detail::kNone;
using detail::with_metric;

std::size_t HierarchyView::size() const { return structure_->count(); }
std::size_t HierarchyView::capacity() const { return structure_->slot_of_id.size(); }
bool HierarchyView::contains(std::int32_t id) const { return structure_->contains(id); }
const Box& HierarchyView::box() const { return structure_->box; }
const HierarchyParams& HierarchyView::params() const { return structure_->params; }
bool HierarchyView::repair_pending() const { return structure_->pending; }
int HierarchyView::levels() const { return static_cast<int>(structure_->levels.size()); }

Vec3 HierarchyView::position(std::int32_t id) const {
  if (!contains(id)) throw InvalidParameter("position(): there is no point with id " + std::to_string(id));
  return structure_->raw[id];
}

LevelInfo HierarchyView::level(int i) const {
  if (i < 0 || i >= levels())
    throw InvalidParameter("level " + std::to_string(i) + " of a hierarchy with levels 0.." +
                           std::to_string(levels() - 1));
  const auto& level = structure_->levels[i];
  LevelInfo info;
  info.covering_radius = level.radius;
  info.edge_threshold = level.threshold;
  info.nodes = structure_->alive(i) + structure_->singletons_above(i);
  info.edges = i > 0 ? level.edges.entries() / 2 : -1;
  for (std::int32_t k = 0; k < level.size(); ++k)
    info.max_degree =
        std::max<std::int64_t>(info.max_degree, static_cast<std::int64_t>(level.edges.row(k).size()));
  return info;
}

int HierarchyView::top_level(std::int32_t id) const {
  if (!contains(id)) throw InvalidParameter("top_level(): there is no point with id " + std::to_string(id));
  int i = structure_->is_singleton_point(id) ? structure_->lowest_node(id).level : 0;
  while (i < structure_->top() && structure_->node_of(id, i + 1) != kNone) ++i;
  return i;
}

namespace {
[[noreturn]] void throw_not_in_level(std::int32_t id, int i) {
  throw InvalidParameter("point " + std::to_string(id) + " does not stand in level " + std::to_string(i));
}
}  // namespace

std::int32_t HierarchyView::parent(std::int32_t id, int i) const {
  if (structure_->stands_alone(id, i)) return id;
  const std::int32_t node = i < 0 || i >= levels() ? kNone : structure_->node_of(id, i);
  if (node == kNone) throw_not_in_level(id, i);
  const std::int32_t above = structure_->parent(i, node);
  return above == kNone ? kNone : structure_->levels[i + 1].id[above];
}

std::vector<std::int32_t> HierarchyView::neighbors(std::int32_t id, int i) const {
  if (structure_->stands_alone(id, i)) return {};
  const std::int32_t node = i < 0 || i >= levels() ? kNone : structure_->node_of(id, i);
  if (node == kNone) throw_not_in_level(id, i);
  std::vector<std::int32_t> nodes;
  with_metric(structure_->box, [&](const auto& metric) { structure_->neighbors(metric, i, node, nodes); });
  std::vector<std::int32_t> ids(nodes.size());
  std::transform(nodes.begin(), nodes.end(), ids.begin(),
                 [&](std::int32_t k) { return structure_->id(i, k); });
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace dch
