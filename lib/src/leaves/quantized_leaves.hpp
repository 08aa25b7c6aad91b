// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <dch/base/executor.hpp>

#include "base/aligned_vector.hpp"
#include "hierarchy/measured_leaves.hpp"
#include "leaves/labelled_leaves.hpp"
#include "simd/block_measure.hpp"
#include "simd/list_kernels.hpp"

namespace dch::detail {

/// Lengths of one unit of the integers that lists are made with.
struct ListUnits {
  double point = 1, box = 1;  ///< of points, and of the boxes of blocks [length]
};

/// MeasuredLeaves and the radii of LabelledLeaves, rounded to units: 16-bit integers, by block. Points and
/// the boxes around them are relative to an origin in the middle of their leaf, boxes in the units of boxes
/// to the center of their leaf.
struct QuantizedLeaves {
  /// Rounds the points of a leaf.
  using RoundPoints = std::function<void(std::int32_t leaf, const BlockUnits& to_units, BlockPoints* points)>;

  /// @param centers of the leaves
  /// @param round_points by block, where `measured` keeps no offsets
  void quantize(const MeasuredLeaves& measured, const LabelledLeaves& labelled, const ListUnits& to_units,
                Span<const Vec3> centers, Executor* executor, const RoundPoints& round_points = {});

  /// Box around blocks [first, last) of a leaf, in the units of boxes.
  BlockSpan box_of(std::int32_t first, std::int32_t last) const;
  BlockSpans boxes() const;
  std::size_t memory_bytes() const;

  ListUnits units;
  /// By leaf: its origin relative to its center. Origins lie on the lattice of integer units, so they differ
  /// by integers, but for periods of the box and rounding in double [length].
  std::vector<Vec3> origin;
  struct {
    double point = 1, box = 1;
  } per_unit;  ///< the inverse [1/length]
  std::vector<BlockPoints> points;
  std::vector<BlockSpan> spans;
  std::vector<std::array<std::int16_t, kBlock>>
      radii;  ///< 0 in empty lanes; empty if cutoffs do not go by them

 private:
  void quantize_boxes(const MeasuredLeaves::Corners& corners, const BlockUnits& to_units, std::int32_t b);

  AlignedVector<std::int16_t> box_center_[3], box_half_width_[3];
  AlignedVector<std::int32_t> number_;
};

}  // namespace dch::detail
