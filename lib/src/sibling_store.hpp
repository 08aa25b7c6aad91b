// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hierarchy_level.hpp"

namespace dch::detail {

/// The nodes of a level copied so that the children (or all descendants) of one parent lie side by side. Many
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

  /// The level-0 descendants of each node of level `cluster_level` >= 1.
  void fill(const std::vector<Level>& levels, int cluster_level) {
    clear();
    for (std::int32_t cluster = 0; cluster < levels[cluster_level].size(); ++cluster) {
      first.push_back(static_cast<std::int32_t>(node.size()));
      add_descendants(levels, cluster_level, cluster);
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
  void add_descendants(const std::vector<Level>& levels, int i, std::int32_t parent) {
    if (i == 1) return add_children(levels[0], levels[1], parent);
    for (std::int32_t k = levels[i].first_child[parent]; k != kNone; k = levels[i - 1].next_sibling[k])
      add_descendants(levels, i - 1, k);
  }
  void add_children(const Level& level, const Level& above, std::int32_t parent) {
    for (std::int32_t k = above.first_child[parent]; k != kNone; k = level.next_sibling[k]) {
      position.push_back(level.position[k]);
      node.push_back(k);
    }
  }
};

}  // namespace dch::detail
