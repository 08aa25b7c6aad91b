// SPDX-License-Identifier: MIT
#include "hierarchy_impl.hpp"

namespace dch {

using detail::kNone;

void Hierarchy::Impl::attach(int level, std::int32_t node, std::int32_t parent) {
  Level& below = levels[level];
  Level& above = levels[level + 1];
  const std::int32_t first = above.first_child[parent];
  below.parent[node] = parent;
  below.prev_sibling[node] = kNone;
  below.next_sibling[node] = first;
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

void Hierarchy::Impl::disconnect(int level, std::int32_t node) {
  Level& at = levels[level];
  for (const std::int32_t neighbor : at.edges.row(node)) at.edges.erase(neighbor, node);
  at.edges.clear_row(node);
}

}  // namespace dch
