// SPDX-License-Identifier: MIT
//
// Removal of single points (thesis 5.4). A point is taken out of every level first; the children that it
// leaves behind find new parents from the top down. Its children in level 0, of which a ball may hold any
// number, look among the leaves near the one that went, and take their blocks along where they agree.
#include <algorithm>
#include <array>
#include <limits>

#include "hierarchy/hierarchy_impl.hpp"

namespace dch {

using detail::kBlock;
using detail::kNone;
using detail::LatticeMetric;
using detail::Level;
using detail::OpenMetric;
using detail::OrthorhombicMetric;

template <class Metric>
void Hierarchy::Impl::remove(const Metric& metric, std::int32_t point) {
  const bool alone = is_singleton_point(point);
  if (!alone && up(0, slot_of_id[point]) == kNone) {
    remove_from_block(slot_of_id[point]);  // the levels above know nothing of it
    ++stats.visited;
    return;
  }
  Left left = take_out(metric, point);
  while (top() > 1 && levels.back().alive() == 0) pop_level();
  for (int level = top(); level > 0; --level)
    for (const std::int32_t orphan : left.nodes[level])
      attach_under(metric, level, orphan,
                   locate(metric, levels[level].position[orphan], level + 1, left.hint[level + 1]));
  while (left.blocks != kNone) {
    const std::int32_t block = left.blocks;
    points.unlink(left.blocks, block);
    adopt_block(metric, block, left);
  }
  grow_top(metric);
  trim_top();
}

template <class Metric>
Hierarchy::Impl::Left Hierarchy::Impl::take_out(const Metric& metric, std::int32_t point) {
  Left left;
  left.nodes.resize(levels.size());
  left.hint.resize(levels.size());
  const Hint lowest = lowest_node(point);
  if (is_singleton_point(point)) {
    forget_singleton(lowest.level, lowest.node);
    slot_of_id[point] = kNone;
  } else {
    remove_from_block(slot_of_id[point]);
  }
  std::int32_t node = lowest.node;
  for (int level = lowest.level; node != kNone; ++level) {
    Level& at = levels[level];
    leave_children(metric, level, node, left);
    if (at.up[node] == kNone && at.parent[node] != kNone) left.hint[level + 1] = {level + 1, at.parent[node]};
    detach(level, node);
    disconnect(level, node);
    if (balls && level == 1) balls->remove_leaf(node);
    at.retire(node);
    node = at.up[node];
  }
  for (int level = top() - 1; level > 0; --level)
    if (left.hint[level].node == kNone) left.hint[level] = left.hint[level + 1];
  return left;
}

/// The children of a node that goes, but its own node, lose their parent. Where there are some, the nearest
/// neighbor of that node is where to begin to look for another one.
template <class Metric>
void Hierarchy::Impl::leave_children(const Metric& metric, int level, std::int32_t node, Left& left) {
  Level& at = levels[level];
  if (level > 1) {
    while (at.first_child[node] != kNone) {
      left.nodes[level - 1].push_back(at.first_child[node]);
      detach(level - 1, at.first_child[node]);
    }
    stats.visited += static_cast<std::int64_t>(left.nodes[level - 1].size());
  } else {
    left.blocks = at.first_child[node];
  }
  if (level > 1 ? left.nodes[level - 1].empty() : left.blocks == kNone) return;
  // A leaf that covers a child is within 2 R_0, where an edge joins it.
  const double within = 2 * levels[0].radius * kInflate;
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t other : at.edges.row(node)) {
    const double d2 = metric.distance2(at.position[node], at.position[other]);
    if (level == 1 && d2 <= within * within) left.leaves.push_back(other);
    if (d2 >= least) continue;
    least = d2;
    left.hint[level] = {level, other};
  }
  note_tested(static_cast<std::int64_t>(at.edges.row(node).size()));
}

/// A block whose points all find the same parent becomes one of that leaf's as it is.
template <class Metric>
void Hierarchy::Impl::adopt_block(const Metric& metric, std::int32_t block, Left& left) {
  struct Orphan {
    std::int32_t id;
    Vec3 at;
    std::int32_t leaf;
    bool is_center;
  };
  std::array<Orphan, kBlock> orphans{};
  const auto count = static_cast<std::size_t>(points.count[block]);
  bool together = true;
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::int32_t slot = block * kBlock + static_cast<std::int32_t>(lane);
    Orphan& orphan = orphans[lane];
    orphan = {points.id[slot], position_in(slot, metric), kNone, false};
    const Cover cover = leaf_among(metric, orphan.at, left);
    orphan.leaf = promote(metric, 0, orphan.id, orphan.at, cover);
    orphan.is_center = cover.level > 1 && orphan.leaf != kNone;
    if (orphan.is_center) left.leaves.push_back(orphan.leaf);
    together = together && orphan.leaf != kNone && orphan.leaf == orphans[0].leaf;
  }
  if (together) {
    points.give_to(orphans[0].leaf, block);
    points.append(levels[1].first_child[orphans[0].leaf], block);
    if (balls) balls->add_block(*this, block);
  } else {
    points.free_block(block);
  }
  for (std::size_t lane = 0; lane < count; ++lane) {
    const auto& [id, at, leaf, is_center] = orphans[lane];
    if (leaf == kNone) continue;  // a singleton
    const std::int32_t slot = together ? slot_of_id[id] : place_point(id, at, leaf);
    if (is_center) levels[1].down[leaf] = slot;
  }
}

/// A parent for a child in level 0 that a leaf has left behind: the nearest of the leaves near that one, or
/// what there is where these do not cover it.
template <class Metric>
Hierarchy::Impl::Cover Hierarchy::Impl::leaf_among(const Metric& metric, Vec3 at, Left& left) {
  double least = std::numeric_limits<double>::infinity();
  std::int32_t nearest = kNone;
  for (const std::int32_t leaf : left.leaves) {
    const double d2 = metric.distance2(at, levels[1].position[leaf]);
    if (d2 >= least) continue;
    least = d2;
    nearest = leaf;
  }
  note_tested(static_cast<std::int64_t>(left.leaves.size()));
  if (least <= levels[0].radius2) return {1, nearest};
  const Cover cover = locate(metric, at, 1, nearest == kNone ? left.hint[1] : Hint{1, nearest});
  if (cover.level == 1) left.leaves.push_back(cover.parent);
  return cover;
}

void Hierarchy::Impl::trim_top() {
  while (top() > 1 && levels[top() - 1].alive() <= params.max_roots &&
         levels[top() - 1].alive() + singletons_above(top() - 1) <= params.max_roots) {
    for (std::int32_t root = 0; root < levels.back().size(); ++root)
      if (is_singleton(top(), root)) expand(top(), root);
    pop_level();
  }
}

template void Hierarchy::Impl::remove(const OpenMetric&, std::int32_t);
template void Hierarchy::Impl::remove(const OrthorhombicMetric&, std::int32_t);
template void Hierarchy::Impl::remove(const LatticeMetric&, std::int32_t);

}  // namespace dch
