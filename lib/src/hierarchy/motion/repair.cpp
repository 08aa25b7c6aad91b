// SPDX-License-Identifier: MIT
//
// Black-box repair after motion (thesis 5.5.3, corrected: docs/thesis-map.md). From the top level down, with
// all levels above in order:
//   1. cover: every node of the level finds a parent again, near its old one first, or is promoted;
//   2. connect: edges are enumerated among children of equal or neighboring *new* parents, which
//      Lemma 5.3.1(5) makes complete for any displacement; from level 2 on only where they may have become
//      incomplete;
//   3. separate: of two nodes within R_{i-1} one is demoted, and its children are handed to the other, to be
//      looked at when their own level's turn comes.
// Attaching the orphans one after the other, each promoted one with its edges at once, keeps the centers
// separated.
#include <algorithm>
#include <cmath>

#include "hierarchy/hierarchy_impl.hpp"

namespace dch {

using detail::kNone;
using detail::Level;

template <class Metric>
void Hierarchy::Impl::repair(const Metric& metric) {
  const std::int64_t reparented_before = stats.reparented;
  balls.reset();
  for (int i = top(); i > 0; --i) {
    if (i < top()) cover_level(metric, i);
    if (edges_are_complete(i)) {
      find_too_close(metric, i);
    } else {
      connect_level(metric, i);
    }
    expand_joined(i);
    separate_level(i);
  }
  cover_points(metric);  // which have no separation to keep, and whose edges are the lists
  trim_top();
  collapse();
  ++stats.repairs;
  pending = false;
  note_new_places();
  misplaced += stats.reparented - reparented_before;
  if (static_cast<double>(misplaced) > detail::kMaxMisplaced * static_cast<double>(raw.size())) reorder();
}

/// Whether no point of a leaf was too far from its center when they were measured. Leaves that are new
/// since then hold none but those that were found to be near enough.
bool Hierarchy::Impl::is_known_to_cover(std::int32_t leaf) const {
  const auto& known = leaves.leaves;
  return static_cast<std::size_t>(leaf) >= known.size() || known[leaf].uncovered == 0;
}

template <class Metric>
void Hierarchy::Impl::cover_points(const Metric& metric) {
  uncovered_points.clear();
  for (std::int32_t k = 0; k < levels[1].size(); ++k) {
    if (is_known_to_cover(k)) continue;  // as a dead one has no children
    const Vec3 center = levels[1].position[k];
    for_each_child(1, k, [&](std::int32_t slot) {
      ++stats.distances;
      if (metric.distance2(position_in(slot, metric), center) > levels[0].radius2)
        uncovered_points.push_back(points.id[slot]);
    });
  }
  for (const std::int32_t point : uncovered_points) {
    const std::int32_t slot = slot_of_id[point];
    const Hint hint{1, points.parent(slot)};
    const Vec3 at = position_in(slot, metric);
    remove_from_block(slot);
    attach_point_under(metric, point, at, locate(metric, at, 1, hint));
    ++stats.reparented;
    grow_top(metric);
  }
}

template <class Metric>
void Hierarchy::Impl::cover_level(const Metric& metric, int i) {
  // Sizes are read anew on each turn: attaching a node may grow the levels above, never this one. All have a
  // parent, since demote() hands the children on.
  for (std::int32_t k = 0; k < levels[i].size(); ++k) {
    const Level& level = levels[i];
    if (!level.is_alive(k) || level.up[k] != kNone) continue;
    const std::int32_t parent = level.parent[k];
    ++stats.distances;
    if (metric.distance2(level.position[k], levels[i + 1].position[parent]) <= level.radius2) continue;
    attach_under(metric, i, k, locate(metric, level.position[k], i + 1, {i + 1, parent}));
    ++stats.reparented;
    grow_top(metric);
  }
}

// The level below needs all edges within rho_i + kEdgeSlack R_i / 2, to find all within its own reach. Of two
// nodes, one may have come when the other had moved already, which then counts twice.
bool Hierarchy::Impl::edges_are_complete(int i) const {
  const Level& level = levels[i];
  return i > 1 &&
         level.complete - 3 * level.moved >= level.threshold + 0.5 * kEdgeSlack * level.radius * kInflate;
}

/// What connect_level() finds, where edges are known to be complete.
template <class Metric>
void Hierarchy::Impl::find_too_close(const Metric& metric, int i) {
  const Level& level = levels[i];
  const double separation2 = levels[i - 1].radius2;
  too_close.clear();
  for (std::int32_t k = 0; k < level.size(); ++k)
    for (const std::int32_t other : level.edges.row(k))
      if (k < other && metric.distance2(level.position[k], level.position[other]) <= separation2)
        too_close.push_back({k, other});
  stats.distances += level.edges.entries() / 2;
}

template <class Metric>
void Hierarchy::Impl::connect_level(const Metric& metric, int i) {
  Level& level = levels[i];
  level.complete = level.longest = level.reach;
  level.moved = 0;
  level.edges.clear();
  level.edges.resize(level.position.size());
  too_close.clear();
  const double separation2 = levels[i - 1].radius2;
  const auto connect_node = [&](std::int32_t k) {
    const std::size_t hits = candidates.select(metric, level.position[k], 0, level.reach * level.reach);
    stats.distances += static_cast<std::int64_t>(candidates.size());
    row.clear();
    for (std::size_t h = 0; h < hits; ++h) {
      const std::size_t c = candidates.hit(h);
      const std::int32_t other = candidates.node(c);
      if (other == k) continue;
      row.push_back(other);
      if (candidates.distance2(c) <= separation2 && k < other) too_close.push_back({k, other});
    }
    level.edges.assign(k, row.data(), static_cast<std::int32_t>(row.size()));
  };

  if (i == top()) {
    candidates.clear();
    for (std::int32_t k = 0; k < level.size(); ++k)
      candidates.append_if(level.is_alive(k), level.position[k], k);
    for (std::int32_t k = 0; k < level.size(); ++k)
      if (level.is_alive(k)) connect_node(k);
    return;
  }
  const Level& above = levels[i + 1];
  const double reach = (level.reach + level.radius) * kInflate,
               parent_reach = (level.reach + 2 * level.radius) * kInflate;
  siblings.fill(level, above);
  for (std::int32_t parent = 0; parent < above.size(); ++parent) {  // dead ones have no children and no edges
    candidates.clear();
    const Vec3 center = above.position[parent];
    const auto gather = [&](std::int32_t near_parent) {
      const std::int32_t begin = siblings.first[near_parent];
      const auto count = static_cast<std::size_t>(siblings.first[near_parent + 1] - begin);
      stats.distances += static_cast<std::int64_t>(count);
      candidates.append_within(
          siblings.position.data() + begin, siblings.node.data() + begin, count, Vec3{},
          [&](Vec3 at) { return metric.distance2(center, at); }, reach * reach);
    };
    gather(parent);
    stats.distances += static_cast<std::int64_t>(above.edges.row(parent).size());
    for (const std::int32_t neighbor : above.edges.row(parent))
      if (metric.distance2(center, above.position[neighbor]) <= parent_reach * parent_reach) gather(neighbor);
    for (std::int32_t k = siblings.first[parent]; k < siblings.first[parent + 1]; ++k)
      connect_node(siblings.node[k]);
  }
}

void Hierarchy::Impl::separate_level(int i) {
  const Level& level = levels[i];
  for (const auto& [a, b] : too_close) {
    if (!level.is_alive(a) || !level.is_alive(b)) continue;
    const bool keep_a = keeps_first(i, a, b);
    demote(i, keep_a ? b : a, keep_a ? a : b);
  }
}

// At most one of them stands in the level above, whose nodes are farther apart than that.
bool Hierarchy::Impl::keeps_first(int i, std::int32_t a, std::int32_t b) const {
  const Level& level = levels[i];
  return level.up[a] != kNone || (level.up[b] == kNone && level.id[a] < level.id[b]);
}

void Hierarchy::Impl::demote(int i, std::int32_t node, std::int32_t successor) {
  Level& level = levels[i];
  if (i > 1) {
    levels[i - 1].up[level.down[node]] = kNone;
    for (std::int32_t child = level.first_child[node]; child != kNone; child = level.first_child[node]) {
      detach(i - 1, child);
      attach(i - 1, child, successor);
    }
  } else {
    std::int32_t& blocks = level.first_child[successor];
    std::int32_t given = level.first_child[node];
    points.give_to(successor, given);
    points.append(given, blocks);
    blocks = given;
    auto& known = leaves.leaves;
    if (static_cast<std::size_t>(successor) >= known.size())
      known.resize(static_cast<std::size_t>(successor) + 1);
    ++known[successor].uncovered;  // nothing is known of the points that it gets
  }
  detach(i, node);
  disconnect(i, node);
  level.retire(node);
  ++stats.demotions;
}

#define DCH_INSTANTIATE(Metric)                         \
  template void Hierarchy::Impl::repair(const Metric&); \
  template void Hierarchy::Impl::find_too_close(const Metric&, int);
DCH_INSTANTIATE(detail::OpenMetric)
DCH_INSTANTIATE(detail::OrthorhombicMetric)
DCH_INSTANTIATE(detail::LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch
