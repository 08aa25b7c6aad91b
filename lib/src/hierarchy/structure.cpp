// SPDX-License-Identifier: MIT
#include "hierarchy/structure.hpp"

#include "geometry/metric.hpp"

namespace dch::detail {

std::int32_t Structure::node_of(std::int32_t id, int level) const {
  if (id < 0 || static_cast<std::size_t>(id) >= slot_of_id.size()) return kNone;
  std::int32_t node = slot_of_id[id];
  int i = 0;
  if (is_singleton_point(id)) {
    i = singletons[singleton_at(node)].level;
    node = i <= level ? singletons[singleton_at(node)].node : kNone;
  }
  for (; i < level && node != kNone; ++i) node = up(i, node);
  return node;
}

std::int32_t Structure::singletons_above(int level) const {
  std::int32_t count = 0;
  for (const Singleton& node : singletons) count += node.level > level;
  return count;
}

std::vector<std::int32_t> Structure::singleton_ids() const {
  std::vector<std::int32_t> ids;
  for (const Singleton& node : singletons) ids.push_back(levels[node.level].id[node.node]);
  return ids;
}

template <class Metric>
void Structure::neighbors(const Metric& metric, int level, std::int32_t node,
                          std::vector<std::int32_t>& nodes) const {
  if (level > 0) {
    for (const std::int32_t other : levels[level].edges.row(node))
      if (level == 1 || metric.distance2(levels[level].position[node], levels[level].position[other]) <=
                            levels[level].threshold2)
        nodes.push_back(other);
    return;
  }
  const std::int32_t leaf = points.parent(node);
  const auto look_at_children = [&](std::int32_t parent) {
    for_each_child(1, parent, [&](std::int32_t other) {
      if (other != node &&
          metric.distance2(position_in(node, metric), position_in(other, metric)) <= levels[0].threshold2)
        nodes.push_back(other);
    });
  };
  look_at_children(leaf);
  for (const std::int32_t neighbor : levels[1].edges.row(leaf)) look_at_children(neighbor);
}

#define DCH_INSTANTIATE(Metric) \
  template void Structure::neighbors(const Metric&, int, std::int32_t, std::vector<std::int32_t>&) const;
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch::detail
