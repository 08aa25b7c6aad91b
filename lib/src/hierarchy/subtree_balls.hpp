// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hierarchy/block_boxes.hpp"
#include "hierarchy/level.hpp"
#include "hierarchy/measured_leaves.hpp"

namespace dch::detail {

struct Structure;

/// The implicit balls of a hierarchy as they are: for each node of level 1 and above the radius of a ball
/// around it that holds the points below it; and boxes around the points of each block. Either measured once,
/// or kept up as points come and go: then balls and boxes may be larger than they need be.
class SubtreeBalls {
 public:
  /// The points must have been measured.
  explicit SubtreeBalls(const Structure& structure);

  double radius(int level, std::int32_t node) const { return levels_[level].radius[node]; }
  /// How many points there are below a node, as measured: that is not kept up.
  std::int64_t count(int level, std::int32_t node) const { return levels_[level].count[node]; }
  /// Around the points of each block.
  const BlockBoxes& boxes() const { return boxes_; }

  // To be called when something has got its place in a structure that is in order: O(levels) each.
  void add_node(int level, std::int32_t node);
  void add_point(const Structure& structure, std::int32_t slot);
  void add_block(const Structure& structure, std::int32_t block);
  void add_subtree(const Structure& structure, int level, std::int32_t node);
  // To be called when it has lost its place.
  void remove_block(std::int32_t leaf, std::int32_t block) { boxes_.remove(leaf, block); }
  void remove_leaf(std::int32_t leaf) { boxes_.remove_all(leaf); }

  std::size_t memory_bytes() const;

 private:
  struct Balls {
    std::vector<double> radius;       ///< by node [length]
    std::vector<std::int64_t> count;  ///< by node
  };
  void measure_leaves(const Structure& structure);
  template <class Metric>
  void measure_level(const Metric& metric, const Structure& structure, int level);
  template <class Metric>
  void widen_above(const Metric& metric, const Structure& structure, int level, std::int32_t node, Vec3 at,
                   double radius);

  std::vector<Balls> levels_;
  BlockBoxes boxes_;
};

}  // namespace dch::detail
