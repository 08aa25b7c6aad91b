// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/executor.hpp>

#include "base/aligned_vector.hpp"
#include "hierarchy/measured_leaves.hpp"
#include "leaves/labelled_leaves.hpp"
#include "simd/list_kernels.hpp"

namespace dch::detail {

/// Lengths of one unit of the integers that lists are made with.
struct ListUnits {
  double point = 1, box = 1;  ///< of points, and of the boxes of blocks [length]
};

/// MeasuredLeaves and the radii of LabelledLeaves, rounded to units: 16-bit integers, by block.
struct QuantizedLeaves {
  void quantize(const MeasuredLeaves& measured, const LabelledLeaves& labelled, const ListUnits& to_units,
                Executor* executor);

  /// Box around blocks [first, last) of a leaf, in the units of boxes.
  BlockSpan box_of(std::int32_t first, std::int32_t last) const;
  BlockSpans boxes() const;
  std::size_t memory_bytes() const;

  ListUnits units;
  struct {
    double point = 1, box = 1;
  } per_unit;  ///< the inverse [1/length]
  std::vector<BlockPoints> points;
  std::vector<BlockSpan> spans;
  std::vector<std::array<std::int16_t, kBlock>>
      radii;  ///< 0 in empty lanes; empty if cutoffs do not go by them

 private:
  void quantize_block(const MeasuredLeaves& measured, const LabelledLeaves& labelled, std::int32_t b);

  AlignedVector<std::int16_t> box_center_[3], box_half_width_[3];
  AlignedVector<std::int32_t> number_;
};

}  // namespace dch::detail
