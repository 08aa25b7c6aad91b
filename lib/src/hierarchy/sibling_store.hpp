// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hierarchy/level.hpp"

namespace dch::detail {

/// The nodes of a level copied so that the children of one parent lie side by side. Many
/// parents read the same children in turn, and following their links each time would cost more than this one
/// pass.
struct SiblingStore {
  std::vector<std::int32_t> first;  ///< children of parent k are [first[k], first[k + 1])
  std::vector<Vec3> position;
  std::vector<std::int32_t> node;

  /// The children of each node of the level above.
  void fill(const Level& level, const Level& above) {
    clear();
    for (std::int32_t parent = 0; parent < above.size(); ++parent) {
      first.push_back(static_cast<std::int32_t>(node.size()));
      add_children(level, above, parent);
    }
    first.push_back(static_cast<std::int32_t>(node.size()));
  }

  std::size_t memory_bytes() const {
    return position.capacity() * sizeof(Vec3) + (first.capacity() + node.capacity()) * sizeof(std::int32_t);
  }

 private:
  void clear() {
    first.clear();
    position.clear();
    node.clear();
  }
  void add_children(const Level& level, const Level& above, std::int32_t parent) {
    for (std::int32_t k = above.first_child[parent]; k != kNone; k = level.next_sibling[k]) {
      position.push_back(level.position[k]);
      node.push_back(k);
    }
  }
};

}  // namespace dch::detail
