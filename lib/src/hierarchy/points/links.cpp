// SPDX-License-Identifier: MIT
#include "hierarchy/hierarchy_impl.hpp"

namespace dch {

using detail::kBlock;
using detail::kNone;

namespace {
constexpr int kMaxFullBlocks = 8;  ///< of a chain, looked at to find room for a point
}

void Hierarchy::Impl::attach(int level, std::int32_t node, std::int32_t parent) {
  if (is_singleton(level + 1, parent)) expand(level + 1, parent);
  Level& below = levels[level];
  Level& above = levels[level + 1];
  const std::int32_t first = above.first_child[parent];
  below.parent[node] = parent;
  below.next_sibling[node] = first;  // one before it has neither a new node nor one that was detached
  if (first != kNone) below.prev_sibling[first] = node;
  above.first_child[parent] = node;
}

void Hierarchy::Impl::detach(int level, std::int32_t node) {
  Level& below = levels[level];
  if (below.parent[node] == kNone) return;
  const std::int32_t previous = below.prev_sibling[node];
  const std::int32_t next = below.next_sibling[node];
  if (previous != kNone) {
    below.next_sibling[previous] = next;
  } else {
    levels[level + 1].first_child[below.parent[node]] = next;
  }
  if (next != kNone) below.prev_sibling[next] = previous;
  below.parent[node] = below.prev_sibling[node] = below.next_sibling[node] = kNone;
}

// The chain turns like the hand of a clock past blocks that are full. A block is added only where a few in
// turn are full, so the others are filled again, and a chain of any length costs the same.
std::int32_t Hierarchy::Impl::place_point(std::int32_t point, Vec3 at, std::int32_t leaf) {
  std::int32_t& first = levels[1].first_child[leaf];
  int full = 0;
  for (; first != kNone && full < kMaxFullBlocks && points.count[first] == kBlock; ++full) points.turn(first);
  stats.visited += full + 1;
  if (first == kNone || full == kMaxFullBlocks) {
    std::int32_t added = points.add_block(leaf);
    points.append(added, first);
    first = added;
  }
  return slot_of_id[point] = points.push(first, point, at);
}

// Blocks stay filled from the front: the last point of the block moves into the gap.
void Hierarchy::Impl::remove_from_block(std::int32_t slot) {
  const std::int32_t block = slot / kBlock;
  const std::int32_t last = block * kBlock + --points.count[block];
  slot_of_id[points.id[slot]] = kNone;
  if (slot != last) {
    if (up(0, last) != kNone) levels[1].down[points.leaf[block]] = slot;
    points.position[slot] = points.position[last];
    points.id[slot] = points.id[last];
    slot_of_id[points.id[slot]] = slot;
  }
  points.id[last] = kNone;
  --points.alive;
  if (points.count[block] > 0) return;
  points.unlink(levels[1].first_child[points.leaf[block]], block);
  points.free_block(block);
}

void Hierarchy::Impl::disconnect(int level, std::int32_t node) {
  Level& at = levels[level];
  for (const std::int32_t neighbor : at.edges.row(node)) at.edges.erase(neighbor, node);
  at.edges.clear_row(node);
}

}  // namespace dch
