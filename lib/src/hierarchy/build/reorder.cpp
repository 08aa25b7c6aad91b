// SPDX-License-Identifier: MIT
#include <numeric>

#include "hierarchy/build/fill_leaves.hpp"

namespace dch {

using detail::kNone;
using detail::Level;
using detail::with_metric;

namespace {

/// New index of every node of a level such that the children of one parent are neighbors in memory; kNone if
/// dead.
std::vector<std::int32_t> depth_first_order(const Level& level, const Level* above) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(level.size()), kNone);
  std::int32_t next = 0;
  if (!above) {
    for (std::int32_t k = 0; k < level.size(); ++k)
      if (level.is_alive(k)) order[k] = next++;
    return order;
  }
  for (std::int32_t parent = 0; parent < above->size(); ++parent)
    for (std::int32_t k = above->first_child[parent]; k != kNone; k = level.next_sibling[k])
      order[k] = next++;
  return order;
}

std::int32_t renamed(const std::vector<std::int32_t>& order, std::int32_t k) { return k < 0 ? k : order[k]; }

}  // namespace

// From the top down: when a level is moved, the one above is in its final order already.
std::vector<std::int32_t> Hierarchy::Impl::reorder_levels() {
  std::vector<std::int32_t> order;
  for (int i = top(); i > 0; --i) {
    const Level& old = levels[i];
    order = depth_first_order(old, i == top() ? nullptr : &levels[i + 1]);
    Level fresh;
    fresh.radius = old.radius;
    fresh.radius2 = old.radius2;
    fresh.threshold = old.threshold;
    fresh.threshold2 = old.threshold2;
    fresh.reach = old.reach;
    fresh.complete = old.complete;
    fresh.moved = old.moved;
    fresh.longest = old.longest;
    fresh.resize(old.alive());
    fresh.edges.reserve(old.edges.entries());
    std::vector<std::int32_t> old_of_new(static_cast<std::size_t>(old.alive()));
    for (std::int32_t k = 0; k < old.size(); ++k)
      if (order[k] != kNone) old_of_new[order[k]] = k;
    for (std::int32_t k = 0; k < fresh.size(); ++k) {
      const std::int32_t from = old_of_new[k];
      fresh.position[k] = old.position[from];
      fresh.id[k] = old.id[from];
      fresh.parent[k] = old.parent[from];  // the level above has renamed these already
      fresh.up[k] = old.up[from];
      fresh.down[k] = old.down[from];
      if (is_singleton(i, from)) singletons[singleton_at(old.down[from])].node = k;
      fresh.first_child[k] = old.first_child[from];
      fresh.next_sibling[k] = renamed(order, old.next_sibling[from]);
      fresh.prev_sibling[k] = renamed(order, old.prev_sibling[from]);
      row.clear();
      for (const std::int32_t neighbor : old.edges.row(from)) row.push_back(order[neighbor]);
      fresh.edges.assign(k, row.data(), static_cast<std::int32_t>(row.size()));
    }
    levels[i] = std::move(fresh);
    if (i < top())
      for (auto* links : {&levels[i + 1].first_child, &levels[i + 1].down})
        for (std::int32_t& k : *links) k = renamed(order, k);
    if (i > 1)
      for (auto* links : {&levels[i - 1].parent, &levels[i - 1].up})
        for (std::int32_t& k : *links) k = renamed(order, k);
  }
  return order;
}

void Hierarchy::Impl::reorder() {
  reorder_levels();
  reorder_points();
  misplaced = 0;
}

/// Puts blocks into the order of their leaves if they are to be laid out anew, where no positions stand in
/// them: then lists read ids from them as they are.
void Hierarchy::Impl::order_blocks() {
  if (points.keeps_positions || leaves.layout != 0) return;
  Level& centers = levels[1];
  std::int32_t blocks = 0;
  bool are_in_order = true;
  for (std::int32_t k = 0; k < centers.size(); ++k)  // a dead one has no children
    for (std::int32_t block = centers.first_child[k]; block != kNone; block = points.next[block], ++blocks)
      are_in_order = are_in_order && block == blocks;
  if (are_in_order) return;
  detail::LeafBlocks fresh;
  fresh.most = points.most;
  fresh.keeps_positions = false;
  fresh.reserve(blocks);  // all the memory that this takes
  for (std::int32_t k = 0; k < centers.size(); ++k) {
    if (!centers.is_alive(k)) continue;
    std::int32_t chain = kNone;
    for (std::int32_t from = centers.first_child[k]; from != kNone; from = points.next[from]) {
      const std::int32_t block = fresh.add_block(k);
      fresh.append(chain, block);
      for (std::int32_t lane = 0; lane < points.count[from]; ++lane) {
        const std::int32_t id = points.id[from * detail::kBlock + lane];
        slot_of_id[id] = fresh.push(block, id, {});
      }
    }
    centers.first_child[k] = chain;
    if (chain != kNone) centers.down[k] = slot_of_id[centers.id[k]];
  }
  points = std::move(fresh);
}

void Hierarchy::Impl::Members::sort(const std::vector<std::int32_t>& leaf_of, std::int32_t leaf_count) {
  std::vector<std::int32_t> next(static_cast<std::size_t>(leaf_count) + 1, 0);
  for (const std::int32_t leaf : leaf_of)
    if (leaf >= 0) ++next[leaf + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  first = next;
  index.resize(static_cast<std::size_t>(first.back()));
  for (std::size_t k = 0; k < leaf_of.size(); ++k)
    if (leaf_of[k] >= 0) index[next[leaf_of[k]]++] = static_cast<std::int32_t>(k);
}

void Hierarchy::Impl::reorder_points() {
  std::vector<std::int32_t> leaf_of(points.id.size(), kNone);
  for (std::int32_t k = 0; k < levels[1].size(); ++k)
    for_each_child(1, k, [&](std::int32_t slot) { leaf_of[slot] = k; });
  detail::LeafBlocks fresh;
  fresh.most = points.most;
  fresh.keeps_positions = points.keeps_positions;
  with_metric(box, [&](const auto& metric) {
    fill_leaves(
        metric, fresh, leaf_of, [&](std::size_t slot) { return points.id[slot]; },
        [&](std::size_t slot) { return position_in(static_cast<std::int32_t>(slot), metric); });
  });
  points = std::move(fresh);
}

}  // namespace dch
