// SPDX-License-Identifier: MIT
//
// Places for single points: descents, promotion, insertion (thesis 5.4, corrected: docs/thesis-map.md).
#include <algorithm>
#include <cmath>

#include "hierarchy/hierarchy_impl.hpp"

namespace dch {

using detail::kNone;
using detail::LatticeMetric;
using detail::OpenMetric;
using detail::OrthorhombicMetric;

// A node of level t = `target` within `reach` of p has its ancestor of level l within
// reach + R_t + ... + R_{l-1} = reach + R_l - R_t of p, so a descent that keeps the nodes within that misses
// none.
//
// A hint a of level l replaces the descent's upper part: if |pa| plus that is at most rho_l, every node
// wanted is within rho_l of a, hence a itself or one of its neighbors. If that holds for a it holds for a's
// parent too, since |pa| grows by at most R_l, what is kept by R_l, and rho_l by 2 R_l or more.
template <class Metric>
Hierarchy::Impl::Hint Hierarchy::Impl::find_near(const Metric& metric, Vec3 at, int target, double reach,
                                                 Hint hint) {
  near.resize(std::max(near.size(), levels.size()));
  const double less = levels[target].radius;
  // Climb until the hint's surroundings are wide enough.
  Hint start = hint.node == kNone ? Hint{top(), kNone} : hint;
  std::int64_t tested = 0;
  for (; start.level < top(); ++start.level, ++tested) {
    const double room =
        levels[start.level].threshold - (reach + levels[start.level].radius - less) * kInflate;
    const double d2 = metric.distance2(at, levels[start.level].position[start.node]);
    if (room > 0 && d2 * (kInflate * kInflate) <= room * room) break;
    start.node = levels[start.level].parent[start.node];
  }
  search_around(metric, at, start, reach + levels[start.level].radius - less);
  for (int level = start.level; level > target; --level) {
    const double within = (reach + levels[level - 1].radius - less) * kInflate;
    near[level - 1].clear();
    for (const Near& kept : near[level]) {
      if (is_singleton(level, kept.node) && kept.distance2 <= within * within) expand(level, kept.node);
      for (std::int32_t child = levels[level].first_child[kept.node]; child != kNone;
           child = levels[level - 1].next_sibling[child], ++tested) {
        const double d2 = metric.distance2(at, levels[level - 1].position[child]);
        if (d2 <= within * within) near[level - 1].push_back({child, d2});
      }
    }
  }
  note_tested(tested);
  return start;
}

/// Fills near[] of a node's level with those of its neighbors, itself and in the top level all that are
/// within reach of a point.
template <class Metric>
void Hierarchy::Impl::search_around(const Metric& metric, Vec3 at, Hint middle, double reach) {
  const Level& level = levels[middle.level];
  const double reach2 = reach * reach * (kInflate * kInflate);
  near[middle.level].clear();
  const auto keep = [&](std::int32_t node) {
    const double d2 = metric.distance2(at, level.position[node]);
    if (d2 <= reach2) near[middle.level].push_back({node, d2});
  };
  if (middle.level == top()) {
    for (std::int32_t root = 0; root < level.size(); ++root)
      if (level.is_alive(root)) keep(root);
    note_tested(level.alive());
    stats.visited += level.size() - level.alive();
    return;
  }
  keep(middle.node);
  for (const std::int32_t neighbor : level.edges.row(middle.node)) keep(neighbor);
  note_tested(1 + static_cast<std::int64_t>(level.edges.row(middle.node).size()));
}

// A parent of level t has to be within R_{t-1} = R_t / 2; its ancestor of level l then is within R_l -
// R_{t-1}, and so is a parent in level l, which has to be within R_{l-1}.
template <class Metric>
Hierarchy::Impl::Cover Hierarchy::Impl::locate(const Metric& metric, Vec3 at, int target, Hint hint) {
  if (target > top()) return {target, kNone};
  const double reach = 0.5 * levels[target].radius;
  Hint guide = find_near(metric, at, target, reach, hint);
  for (int level = target; level <= top(); ++level) {
    if (level > guide.level) {
      guide = {level, levels[level - 1].parent[guide.node]};
      search_around(metric, at, guide, levels[level].radius - reach);
    }
    const double limit2 = levels[level - 1].radius2;
    const Near* best = nullptr;
    for (const Near& kept : near[level])
      if (kept.distance2 <= limit2 && (!best || kept.distance2 < best->distance2)) best = &kept;
    if (best) return {level, best->node};
  }
  return {top() + 1, kNone};
}

template <class Metric>
void Hierarchy::Impl::connect(const Metric& metric, int level, std::int32_t node) {
  Level& at = levels[level];
  at.longest = std::max(at.longest, at.reach);
  const Vec3 position = at.position[node];
  std::int64_t tested = 0;
  row.clear();
  const auto join = [&](std::int32_t other) {
    if (other == node) return;
    ++tested;
    if (metric.distance2(position, at.position[other]) > at.reach * at.reach) return;
    row.push_back(other);
    at.edges.push(other, node);
    if (is_singleton(level, other)) expand(level, other);
  };
  if (level == top()) {
    for (std::int32_t root = 0; root < at.size(); ++root)
      if (at.is_alive(root)) join(root);
    stats.visited += at.size() - at.alive();
  } else {
    const Level& above = levels[level + 1];
    const double reach = (at.reach + at.radius) * kInflate;
    const auto join_children = [&](std::int32_t parent) {
      ++tested;
      if (metric.distance2(position, above.position[parent]) > reach * reach) return;
      for (std::int32_t child = above.first_child[parent]; child != kNone; child = at.next_sibling[child])
        join(child);
    };
    const std::int32_t parent = at.parent[node];
    join_children(parent);
    for (const std::int32_t neighbor : above.edges.row(parent)) join_children(neighbor);
  }
  at.edges.assign(node, row.data(), static_cast<std::int32_t>(row.size()));
  note_tested(tested);
}

template <class Metric>
std::int32_t Hierarchy::Impl::promote(const Metric& metric, int level, std::int32_t point, Vec3 at,
                                      Cover cover) {
  std::int32_t above = cover.parent;
  // From the top down, since a node's edges are found among the children of its parent's neighbors.
  for (int i = cover.level - 1; i > level; --i) {
    const std::int32_t promoted = add_node(i, point, at);
    if (above != kNone) attach(i, promoted, above);
    if (i < cover.level - 1) {
      levels[i].up[promoted] = above;
      levels[i + 1].down[above] = promoted;
    }
    connect(metric, i, promoted);
    ++stats.promotions;
    above = promoted;
    if (level == 0 && i > 1 && params.collapse_singletons && levels[i].edges.row(promoted).empty()) {
      make_singleton(i, promoted);
      return kNone;
    }
  }
  return above;
}

template <class Metric>
void Hierarchy::Impl::attach_under(const Metric& metric, int level, std::int32_t node, Cover cover) {
  const std::int32_t above =
      promote(metric, level, levels[level].id[node], levels[level].position[node], cover);
  detach(level, node);
  if (above == kNone) return;  // a root
  attach(level, node, above);
  if (cover.level == level + 1) return;
  levels[level].up[node] = above;
  levels[level + 1].down[above] = node;
}

template <class Metric>
void Hierarchy::Impl::attach_point_under(const Metric& metric, std::int32_t point, Vec3 at, Cover cover) {
  const std::int32_t above = promote(metric, 0, point, at, cover);
  if (above == kNone) return;  // a singleton
  const std::int32_t slot = place_point(point, at, above);
  if (cover.level > 1) levels[1].down[above] = slot;
}

template <class Metric>
void Hierarchy::Impl::grow_top(const Metric& metric) {
  while (levels.back().alive() > params.max_roots) {
    push_level();
    const int i = top() - 1;
    for (std::int32_t node = 0; node < levels[i].size(); ++node) {
      if (!levels[i].is_alive(node)) continue;
      attach_under(metric, i, node, locate(metric, levels[i].position[node], i + 1, {}));
    }
  }
}

template <class Metric>
void Hierarchy::Impl::insert(const Metric& metric, std::int32_t point, Vec3 at, Hint hint) {
  const Vec3 wrapped = box.wrap(at);
  raw[point] = at;
  attach_point_under(metric, point, wrapped, locate(metric, wrapped, 1, hint));
  grow_top(metric);
}

#define DCH_INSTANTIATE(Metric)                                                                      \
  template Hierarchy::Impl::Hint Hierarchy::Impl::find_near(const Metric&, Vec3, int, double, Hint); \
  template std::int32_t Hierarchy::Impl::promote(const Metric&, int, std::int32_t, Vec3, Cover);     \
  template Hierarchy::Impl::Cover Hierarchy::Impl::locate(const Metric&, Vec3, int, Hint);           \
  template void Hierarchy::Impl::attach_under(const Metric&, int, std::int32_t, Cover);              \
  template void Hierarchy::Impl::attach_point_under(const Metric&, std::int32_t, Vec3, Cover);       \
  template void Hierarchy::Impl::connect(const Metric&, int, std::int32_t);                          \
  template void Hierarchy::Impl::grow_top(const Metric&);                                            \
  template void Hierarchy::Impl::insert(const Metric&, std::int32_t, Vec3, Hint);
DCH_INSTANTIATE(OpenMetric)
DCH_INSTANTIATE(OrthorhombicMetric)
DCH_INSTANTIATE(LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch
