// SPDX-License-Identifier: MIT
//
// Path compression: points on their own (docs/decisions/0009-points-on-their-own.md). A node that has itself
// as its only descendant and no edge stands in no level below in memory. If no node of level i is within
// rho_i of it, none of level j < i is within rho_j: such a node's ancestor in level i is within R_i - R_j of
// it, and rho_i >= rho_j + 2 (R_i - R_j).
#include "hierarchy/hierarchy_impl.hpp"

namespace dch {

using detail::kNone;

void Hierarchy::Impl::make_singleton(int level, std::int32_t node) {
  const std::int32_t place = place_of_singleton(static_cast<std::int32_t>(singletons.size()));
  singletons.push_back({level, node});
  levels[level].down[node] = place;
  slot_of_id[levels[level].id[node]] = place;
}

void Hierarchy::Impl::forget_singleton(int level, std::int32_t node) {
  const std::int32_t place = levels[level].down[node];
  levels[level].down[node] = kNone;
  const Singleton last = singletons.back();
  singletons.pop_back();
  if (singleton_at(place) == static_cast<std::int32_t>(singletons.size())) return;
  singletons[singleton_at(place)] = last;
  levels[last.level].down[last.node] = place;
  slot_of_id[levels[last.level].id[last.node]] = place;
}

/// Gives a singleton its node in the level below, which is a singleton again or has the point in a block.
void Hierarchy::Impl::expand(int level, std::int32_t node) {
  const std::int32_t id = levels[level].id[node];
  const Vec3 at = levels[level].position[node];
  forget_singleton(level, node);
  const std::int32_t below = add_node(level - 1, id, at);
  // NOLINTNEXTLINE(readability-suspicious-call-argument): the node is the parent of the one below it
  attach(level - 1, below, node);
  levels[level - 1].up[below] = node;
  levels[level - 1].complete = 0;  // it may have got neighbors there by motion
  levels[level].down[node] = below;
  if (level > 2) {
    make_singleton(level - 1, below);
  } else if (placing_later) {
    slot_of_id[id] = below;
  } else {
    levels[1].down[below] = place_point(id, at, below);
  }
}

void Hierarchy::Impl::expand_joined(int level) {
  for (std::int32_t k = 0; k < levels[level].size(); ++k)
    if (is_singleton(level, k) && !levels[level].edges.row(k).empty()) expand(level, k);
}

/// Whether a node of level 2 or above has no edge and no other descendant than itself, of which the levels
/// below know already if it is a singleton there.
bool Hierarchy::Impl::could_be_singleton(int level, std::int32_t node) const {
  if (!levels[level].edges.row(node).empty()) return false;
  const std::int32_t below = levels[level].down[node];  // of a singleton: no child
  if (levels[level].first_child[node] != below || levels[level - 1].next_sibling[below] != kNone)
    return false;
  if (level > 2) return is_singleton(level - 1, below);
  const std::int32_t block = levels[1].first_child[below];
  return points.count[block] == 1 && points.next[block] == kNone;
}

void Hierarchy::Impl::collapse() {
  if (!params.collapse_singletons) return;
  for (int level = 2; level <= top(); ++level) {
    for (std::int32_t k = 0; k < levels[level].size(); ++k) {
      if (!levels[level].is_alive(k) || !could_be_singleton(level, k)) continue;
      const std::int32_t below = levels[level].down[k];
      if (level > 2) {
        forget_singleton(level - 1, below);
      } else {
        remove_from_block(levels[1].down[below]);
      }
      detach(level - 1, below);
      levels[level - 1].retire(below);
      make_singleton(level, k);
    }
  }
}

}  // namespace dch
