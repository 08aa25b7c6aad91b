// SPDX-License-Identifier: MIT
#include <algorithm>

#include "hierarchy_impl.hpp"

namespace dch {

using detail::kBlock;
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

std::int32_t renamed(const std::vector<std::int32_t>& order, std::int32_t k) {
  return k == kNone ? kNone : order[k];
}

struct LocalPoint {
  Vec3 at;  ///< relative to the cluster's center
  std::int32_t slot;
};

/// Points in the first `block` of `blocks` parts.
std::int32_t share_of_blocks(std::int32_t count, std::int32_t blocks, std::int32_t block) {
  return static_cast<std::int32_t>(static_cast<std::int64_t>(count) * block / blocks);
}

/// Orders points so that the cuts into `blocks` parts of nearly equal size that share_of_blocks() tells are
/// those of a k-d tree.
void order_by_halving(LocalPoint* begin, std::int32_t count, std::int32_t blocks) {
  if (blocks <= 1) return;
  Vec3 low = begin->at, high = low;
  for (const LocalPoint* p = begin + 1; p != begin + count; ++p) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p->at[axis]);
      high[axis] = std::max(high[axis], p->at[axis]);
    }
  }
  const Vec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::int32_t half = blocks / 2;
  const std::int32_t middle = share_of_blocks(count, blocks, half);
  std::nth_element(begin, begin + middle, begin + count,
                   [axis](const LocalPoint& a, const LocalPoint& b) { return a.at[axis] < b.at[axis]; });
  order_by_halving(begin, middle, half);
  order_by_halving(begin + middle, count - middle, blocks - half);
}

}  // namespace

// From the top down: when a level is moved, the one above is in its final order already.
void Hierarchy::Impl::reorder() {
  for (int i = top(); i > 0; --i) {
    const Level& old = levels[i];
    const std::vector<std::int32_t> order = depth_first_order(old, i == top() ? nullptr : &levels[i + 1]);
    Level fresh;
    fresh.radius = old.radius;
    fresh.radius2 = old.radius2;
    fresh.threshold = old.threshold;
    fresh.threshold2 = old.threshold2;
    fresh.resize(old.alive());
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
  reorder_points();
  strayed = 0;
}

void Hierarchy::Impl::reorder_points() {
  detail::PointBlocks fresh;
  const auto expected = static_cast<std::size_t>(points.alive + points.alive / 8 + kBlock * levels[1].size());
  fresh.position.reserve(expected);
  fresh.id.reserve(expected);
  std::vector<LocalPoint> local;
  with_metric(box, [&](const auto& metric) {
    for (std::int32_t k = 0; k < levels[1].size(); ++k) {
      const Vec3 center = levels[1].position[k];
      const std::int32_t own_slot = levels[1].down[k];
      local.clear();
      for_each_child(1, k, [&](std::int32_t slot) {
        local.push_back({metric.displacement(center, points.position[slot]), slot});
      });
      const auto count = static_cast<std::int32_t>(local.size());
      const std::int32_t blocks = (count + kBlock - 1) / kBlock;
      order_by_halving(local.data(), count, blocks);
      std::int32_t last = kNone;
      for (std::int32_t b = 0; b < blocks; ++b) {
        const std::int32_t block = fresh.add_block(k, kNone);
        (last == kNone ? levels[1].first_child[k] : fresh.next[last]) = block;
        last = block;
        for (std::int32_t p = share_of_blocks(count, blocks, b); p < share_of_blocks(count, blocks, b + 1);
             ++p) {
          const std::int32_t old = local[p].slot;
          const std::int32_t slot = fresh.push(block, points.id[old], points.position[old]);
          slot_of_id[points.id[old]] = slot;
          if (old == own_slot) levels[1].down[k] = slot;
        }
      }
    }
  });
  points = std::move(fresh);
}

}  // namespace dch
