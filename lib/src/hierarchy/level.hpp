// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/vec3.hpp>

#include "hierarchy/adjacency_rows.hpp"

namespace dch::detail {

inline constexpr std::int32_t kNone = -1;

/// A level S_i, i >= 1, of the hierarchy: its nodes in flat arrays, one entry a node. A dead node has id
/// kNone and waits in `free` for the next node of this level.
struct Level {
  double radius = 0, radius2 = 0;        ///< R_i: the level above covers this one within it
  double threshold = 0, threshold2 = 0;  ///< rho_i: edges join nodes within it
  double reach = 0;     ///< from level 2 on edges join some farther ones, up to this when made
  double complete = 0;  ///< all within this were joined when edges were last enumerated
  double moved = 0;     ///< how far a node has moved since, at most
  double longest = 0;   ///< no edge was longer when it was made, since then

  std::vector<Vec3> position;              ///< wrapped into the cell
  std::vector<std::int32_t> id;            ///< the caller's name of the point
  std::vector<std::int32_t> parent;        ///< node of the level above; kNone at the top
  std::vector<std::int32_t> up;            ///< own node in the level above (then also the parent), or kNone
  std::vector<std::int32_t> down;          ///< own node in the level below; in level 1 the slot of the point
  std::vector<std::int32_t> first_child;   ///< in the level below; in level 1 the first block of its points
  std::vector<std::int32_t> next_sibling;  ///< children of one parent form a doubly linked list
  std::vector<std::int32_t> prev_sibling;
  std::vector<std::int32_t> free;
  AdjacencyRows edges;  ///< both directions

  std::int32_t size() const { return static_cast<std::int32_t>(id.size()); }
  std::int32_t alive() const { return size() - static_cast<std::int32_t>(free.size()); }
  bool is_alive(std::int32_t k) const { return id[k] != kNone; }

  std::int32_t add(std::int32_t point, Vec3 at) {
    std::int32_t k;
    if (free.empty()) {
      k = size();
      resize(k + 1);
    } else {
      k = free.back();
      free.pop_back();
    }
    position[k] = at;
    id[k] = point;
    parent[k] = up[k] = down[k] = first_child[k] = next_sibling[k] = prev_sibling[k] = kNone;
    return k;
  }
  void retire(std::int32_t k) {
    id[k] = first_child[k] = kNone;  // loops over nodes pass by a dead one, which has no children
    free.push_back(k);
  }
  void resize(std::int32_t n) {
    const auto count = static_cast<std::size_t>(n);
    position.resize(count);
    for (auto* array : {&id, &parent, &up, &down, &first_child, &next_sibling, &prev_sibling})
      array->resize(count, kNone);
    edges.resize(count);
  }
  std::size_t memory_bytes() const {
    return position.capacity() * sizeof(Vec3) + free.capacity() * sizeof(std::int32_t) +
           7 * id.capacity() * sizeof(std::int32_t) + edges.memory_bytes();
  }
};

}  // namespace dch::detail
