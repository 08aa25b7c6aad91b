// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <dch/base/vec3.hpp>

#include "hierarchy/leaf_blocks.hpp"
#include "hierarchy/measured_leaves.hpp"

namespace dch::detail {

/// The boxes around the blocks of each leaf, side by side in groups of eight, so that a query compares eight
/// with a position at once and takes a few lines of memory for a leaf. Boxes come and go in O(1).
class BlockBoxes {
 public:
  static constexpr std::int32_t kBoxes = 8;  ///< of a group

  /// Boxes relative to the center of their leaf [length]. Only the first group of a leaf may have room left.
  struct alignas(64) Group {
    float low[3][kBoxes], high[3][kBoxes];  ///< what is in free places does not matter
    std::int32_t block[kBoxes];             ///< of LeafBlocks
    std::int32_t count, next;
  };

  /// The squared gap between a position and a box, both relative to the center of a leaf, as
  /// for_each_within() computes it, is at most this if they are within a distance of each other: it allows
  /// for rounding, which takes less than 2^-22 of the position and of the corners from a gap, and less than
  /// 2^-20 of it from its square. Infinity where squares do not fit into float.
  /// @param extent of the leaf: no corner is farther from its center along an axis
  static float most_gap2(Vec3 at, double extent, double within) {
    const double far = std::abs(at.x) + std::abs(at.y) + std::abs(at.z) + extent;
    const double most = within + 0x1p-22 * far;
    constexpr double kMost = 1e18, kLeast2 = 1e-30;
    return most + far < kMost ? static_cast<float>(most * most * (1 + 0x1p-20) + kLeast2)
                              : std::numeric_limits<float>::infinity();
  }

  /// Calls f(block, gap2) for the blocks of a leaf whose boxes are no farther from a position.
  /// @returns how many boxes it compared.
  template <class F>
  std::int64_t for_each_within(std::int32_t leaf, Vec3 at, float most2, const F& f) const {
    std::int64_t compared = 0;
    const float position[3] = {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
    for (std::int32_t g = first_[leaf]; g != kNone; g = groups_[g].next) {
      float gap2[kBoxes];
      measure(groups_[g], position, gap2);
      for (std::int32_t n = 0; n < groups_[g].count; ++n)
        if (!(gap2[n] > most2)) f(groups_[g].block[n], gap2[n]);
      compared += groups_[g].count;
    }
    return compared;
  }

  MeasuredLeaves::Corners corners(std::int32_t block) const;

  void add_leaf(std::int32_t leaf);
  /// The block is a new one of the leaf, which has been added.
  void add(std::int32_t leaf, std::int32_t block, const MeasuredLeaves::Corners& box);
  /// Makes a box hold a point.
  void widen(std::int32_t block, const float at[3]);
  void remove(std::int32_t leaf, std::int32_t block);
  void remove_all(std::int32_t leaf);

  std::size_t memory_bytes() const;

 private:
  static constexpr std::int32_t kLanes = 4;  // every processor that has vectors has these
  using Floats __attribute__((vector_size(16))) = float;

  static void measure(const Group& group, const float at[3], float gap2[kBoxes]) {
    for (std::int32_t n = 0; n < kBoxes; n += kLanes) {
      Floats sum{};
      for (int axis = 0; axis < 3; ++axis) {
        Floats low, high;
        std::memcpy(&low, group.low[axis] + n, sizeof low);
        std::memcpy(&high, group.high[axis] + n, sizeof high);
        low -= at[axis];
        high = at[axis] - high;
        const Floats gap = low > high ? low : high;
        const Floats positive = gap > Floats{} ? gap : Floats{};
        sum += positive * positive;
      }
      std::memcpy(gap2 + n, &sum, sizeof sum);
    }
  }
  std::int32_t new_group(std::int32_t next);
  void copy(std::int32_t from, std::int32_t to);

  std::vector<std::int32_t> first_;  ///< by leaf: its first group, or kNone
  std::vector<std::int32_t> place_;  ///< by block: its group times kBoxes and its place there
  std::vector<Group> groups_;
  std::vector<std::int32_t> free_;
};

}  // namespace dch::detail
