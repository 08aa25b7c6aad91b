// SPDX-License-Identifier: MIT
#include <limits>

#include "hierarchy/hierarchy_impl.hpp"

namespace dch {

using detail::kBlock;
using detail::kNone;

namespace {
constexpr int kMaxLookedAt = 16;  ///< of a chain, looked at to find room for a point
}

std::int32_t Hierarchy::Impl::add_node(int level, std::int32_t point, Vec3 at) {
  const std::int32_t node = levels[level].add(point, at);
  if (balls) balls->add_node(level, node);
  return node;
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
  if (balls) balls->add_subtree(*this, level, node);
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

// The chain turns like the hand of a clock past blocks that are full, and of the next few that have room the
// point takes the nearest. A block is added only where a few in turn are full, so the others are filled
// again, and a chain of any length costs the same.
std::int32_t Hierarchy::Impl::place_point(std::int32_t point, Vec3 at, std::int32_t leaf) {
  std::int32_t& first = levels[1].first_child[leaf];
  int looked = 0;
  for (; first != kNone && looked < kMaxLookedAt && points.count[first] == kBlock; ++looked)
    points.turn(first);
  std::int32_t nearest = kNone;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t block = first; block != kNone && looked < kMaxLookedAt; block = points.next[block]) {
    ++looked;
    if (points.count[block] == kBlock) continue;
    const double d2 = norm2(position_in(block * kBlock, box) - at);
    if (d2 >= least) continue;
    least = d2;
    nearest = block;
  }
  stats.visited += looked;
  if (nearest == kNone) {
    nearest = points.add_block(leaf);
    std::int32_t chain = nearest;
    points.append(chain, first);  // NOLINT(readability-suspicious-call-argument): it comes before the others
    first = chain;
  }
  const std::int32_t slot = slot_of_id[point] = points.push(nearest, point, at);
  if (balls) balls->add_point(*this, slot);
  return slot;
}

// Blocks stay filled from the front: the last point of the block moves into the gap.
void Hierarchy::Impl::remove_from_block(std::int32_t slot) {
  const std::int32_t block = slot / kBlock;
  const std::int32_t last = block * kBlock + --points.count[block];
  slot_of_id[points.id[slot]] = kNone;
  if (slot != last) {
    if (up(0, last) != kNone) levels[1].down[points.leaf[block]] = slot;
    points.copy_point(last, slot);
    slot_of_id[points.id[slot]] = slot;
  }
  points.id[last] = kNone;
  --points.alive;
  if (points.count[block] > 0) return;
  if (balls) balls->remove_block(points.leaf[block], block);
  points.unlink(levels[1].first_child[points.leaf[block]], block);
  points.free_block(block);
}

void Hierarchy::Impl::disconnect(int level, std::int32_t node) {
  Level& at = levels[level];
  for (const std::int32_t neighbor : at.edges.row(node)) at.edges.erase(neighbor, node);
  at.edges.clear_row(node);
}

}  // namespace dch
