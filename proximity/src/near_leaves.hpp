// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/proximity/nearest.hpp>

#include "hierarchy/structure.hpp"
#include "hierarchy/subtree_balls.hpp"
#include "simd/nearest_kernels.hpp"

namespace dch::detail {

/// The blocks of points near a leaf, put side by side in the frame of its center.
class NearLeaves {
 public:
  NearLeaves(const Structure& structure, const SubtreeBalls& balls) : structure_(structure), balls_(balls) {}

  /// Collects all images of points within `reach` of the points of a leaf.
  template <class Metric>
  void collect(const Metric& metric, std::int32_t leaf, double reach, NearestWork& work);

  NearBlocks blocks() const;
  std::int32_t count() const { return count_; }
  /// The leaf's own blocks come first.
  std::int32_t own_blocks() const { return own_; }
  /// How far distances computed in float from what is here may be off [length].
  double rounding() const { return rounding_; }

  /// Points of a block.
  std::int32_t points_in(std::int32_t block) const {
    const std::int32_t source = source_[static_cast<std::size_t>(block)];
    return source < 0 ? 1 : structure_.points.count[source];
  }
  /// Of the point in a slot, kBlock a block.
  std::int32_t id(std::int32_t slot) const {
    const std::int32_t source = source_[static_cast<std::size_t>(slot / kBlock)];
    return source < 0 ? id_of(source) : structure_.points.id[source * kBlock + slot % kBlock];
  }
  /// Its position in the cell. In an open box that is the position as given.
  Vec3 wrapped(std::int32_t slot) const {
    const std::int32_t source = source_[static_cast<std::size_t>(slot / kBlock)];
    return source < 0 ? structure_.raw[id_of(source)]
                      : structure_.points.position[source * kBlock + slot % kBlock];
  }

 private:
  struct Subtree {
    std::int32_t level, node;
  };
  /// What source_ holds of a point on its own; an involution.
  static std::int32_t id_of(std::int32_t source) { return -1 - source; }
  void clear();
  void make_room(std::int32_t blocks);
  void add_leaf(std::int32_t leaf, Vec3 shift, double within);
  void add_block(std::int32_t measured, Vec3 shift);
  void add_point(std::int32_t id, Vec3 at);

  const Structure& structure_;
  const SubtreeBalls& balls_;
  std::vector<Subtree> stack_;
  std::int32_t count_ = 0;
  // By block; there is room for kChunk more than there are.
  std::vector<float> low_[3], high_[3];
  std::vector<float> coordinates_;
  std::vector<std::int32_t> source_;  ///< a block of LeafBlocks, or what id_of() tells
  std::int32_t own_ = 0;
  double widest_ = 0;  ///< largest coordinate [length]
  double rounding_ = 0;
};

}  // namespace dch::detail
