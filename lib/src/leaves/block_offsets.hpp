// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <type_traits>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#include "geometry/metric.hpp"
#include "hierarchy/leaf_blocks.hpp"
#include "hierarchy/measured_leaves.hpp"
#include "leaves/rounding.hpp"
#include "simd/block_measure.hpp"

namespace dch::detail {

/// Whatever lanes without a point hold.
inline void round_offsets(const MeasuredLeaves::Offsets& offsets, const BlockUnits& units, BlockPoints& to) {
  std::int16_t* const rows[3] = {to.x, to.y, to.z};
  for (int axis = 0; axis < 3; ++axis)
    for (int lane = 0; lane < kBlock; ++lane)
      rows[axis][lane] = rounded((offsets.axis[axis][lane] - units.origin[axis]) * units.per_unit);
}

/// Positions of the points of blocks relative to the center of their leaf, anew from the positions as given:
/// the numbers that MeasuredLeaves has, where it keeps them.
template <class Metric>
class BlockOffsets {
 public:
  /// All that this gets must outlive it.
  /// @param positions by id
  BlockOffsets(const Metric& metric, Span<const Vec3> positions, const LeafBlocks& blocks)
      : metric_(metric), positions_(positions.data()), blocks_(blocks) {
    if constexpr (kIsBrick) cell_ = metric.brick();
  }

  /// Has the positions of a block fetched that is to be looked at soon: they lie anywhere.
  void ask_for(std::int32_t block) const { blocks_.ask_for(block, positions_); }

  /// Entries of lanes without a point are as they come, here and below.
  void find(std::int32_t block, Vec3 center, MeasuredLeaves::Offsets& to) const {
    const std::int32_t count = blocks_.count[block];
    const std::int32_t* const id = blocks_.id.data() + block * kBlock;
    if constexpr (kIsBrick) {
      const double from[3] = {center.x, center.y, center.z};
      if (kernel_(cell_, &positions_->x, id, count, from, to.axis[0])) return;
    }
    for (std::int32_t lane = 0; lane < count; ++lane) {
      const Vec3 at = metric_.displacement(center, metric_.wrap(positions_[id[lane]]));
      for (int axis = 0; axis < 3; ++axis) to.axis[axis][lane] = static_cast<float>(at[axis]);
    }
  }

  /// The same rounded, as QuantizedLeaves has them.
  /// @param is_plain see BlockExtremes
  void round(std::int32_t block, bool is_plain, Vec3 center, const BlockUnits& units, BlockPoints& to) const {
    static_assert(sizeof to == 3 * kBlock * sizeof(std::int16_t));
    if (is_plain) {
      const double from[3] = {center.x, center.y, center.z};
      round_kernel_(&positions_->x, blocks_.id.data() + block * kBlock, from, units, to.x);
      return;
    }
    MeasuredLeaves::Offsets offsets{};
    find(block, center, offsets);
    round_offsets(offsets, units, to);
  }

 private:
  static constexpr bool kIsBrick = !std::is_same_v<Metric, LatticeMetric>;
  const Metric& metric_;
  const Vec3* positions_;
  const LeafBlocks& blocks_;
  BrickCell cell_;
  OffsetBlock kernel_ = offset_block(instruction_set());
  RoundBlock round_kernel_ = round_block(instruction_set());
};

}  // namespace dch::detail
