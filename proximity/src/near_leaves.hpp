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
  std::int32_t count() const { return static_cast<std::int32_t>(count_.size()); }
  /// Of the point in a slot, kBlock a block.
  std::int32_t id(std::int32_t slot) const { return ids_[static_cast<std::size_t>(slot)]; }
  /// The leaf's own blocks come first.
  std::int32_t own_blocks() const { return own_; }
  /// How far distances computed in float from what is here may be off [length].
  double rounding() const { return rounding_; }

 private:
  struct Subtree {
    std::int32_t level, node;
  };
  void clear();
  void add_leaf(std::int32_t leaf, Vec3 shift, double within);
  void add_point(std::int32_t id, Vec3 at);
  void make_readable();

  const Structure& structure_;
  const SubtreeBalls& balls_;
  std::vector<Subtree> stack_;
  std::vector<float> low_[3], high_[3];  ///< by block, kChunk more than there are
  std::vector<float> coordinates_;
  std::vector<std::uint8_t> count_;
  std::vector<std::int32_t> ids_;
  std::int32_t own_ = 0;
  double widest_ = 0;  ///< largest coordinate [length]
  double rounding_ = 0;
};

}  // namespace dch::detail
