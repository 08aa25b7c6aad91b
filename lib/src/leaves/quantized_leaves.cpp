// SPDX-License-Identifier: MIT
#include "leaves/quantized_leaves.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "leaves/leaf_frame.hpp"
#include "leaves/own_blocks.hpp"
#include "leaves/rounding.hpp"

namespace dch::detail {
namespace {

/// Holds the rounded points between the corners, relative to an origin, and the corners themselves.
BlockSpan span_around(const MeasuredLeaves::Corners& corners, const float origin[3], float per_unit) {
  BlockSpan span{};
  for (int axis = 0; axis < 3; ++axis) {
    const float low = (corners.low[axis] - origin[axis]) * per_unit,
                high = (corners.high[axis] - origin[axis]) * per_unit;
    span.center[axis] = rounded(0.5f * (low + high));
    span.half_width[axis] = static_cast<std::int16_t>(rounded(0.5f * (high - low)) + 2);
  }
  return span;
}

}  // namespace

void QuantizedLeaves::quantize(const MeasuredLeaves& measured, const LabelledLeaves& labelled,
                               const ListUnits& to_units, Span<const Vec3> centers, Executor* executor) {
  units = to_units;
  per_unit = {1 / units.point, 1 / units.box};
  const auto all = static_cast<std::size_t>(measured.blocks);
  points.resize(all);
  spans.resize(all);
  radii.resize(labelled.radii.size());
  origin.resize(measured.leaves.size());
  for (int axis = 0; axis < 3; ++axis) {
    box_center_[axis].resize(all + kChunk);
    box_half_width_[axis].resize(all + kChunk);
  }
  if (number_.size() < all + kChunk) {
    number_.resize(all + kChunk);
    std::iota(number_.begin(), number_.end(), 0);
  }
  for_ranges(executor, static_cast<std::int32_t>(origin.size()), [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t k = first; k < last; ++k) {
      const MeasuredLeaves::Leaf& leaf = measured.leaves[k];
      origin[k] = frame_origin(centers[k], leaf.middle, units.point);
      float from[3];
      for (int axis = 0; axis < 3; ++axis) from[axis] = static_cast<float>(origin[k][axis]);
      for (std::int32_t b = leaf.first_block; b < leaf.first_block + leaf.blocks; ++b)
        quantize_block(measured, labelled, from, b);
    }
  });
}

/// @param from the origin of the leaf, relative to its center
void QuantizedLeaves::quantize_block(const MeasuredLeaves& measured, const LabelledLeaves& labelled,
                                     const float from[3], std::int32_t b) {
  constexpr float kCenter[3] = {0, 0, 0};
  const auto per_point = static_cast<float>(per_unit.point), per_box = static_cast<float>(per_unit.box);
  const auto round_all = [&](const float* lengths, float less, std::int16_t* to) {
    for (int lane = 0; lane < kBlock; ++lane) to[lane] = rounded((lengths[lane] - less) * per_point);
  };
  round_all(measured.offsets[b].axis[0], from[0], points[b].x);  // whatever empty lanes hold
  round_all(measured.offsets[b].axis[1], from[1], points[b].y);
  round_all(measured.offsets[b].axis[2], from[2], points[b].z);
  if (!radii.empty()) round_all(labelled.radii[b].data(), 0, radii[b].data());
  spans[b] = span_around(measured.corners[b], from, per_point);
  const BlockSpan box = span_around(measured.corners[b], kCenter, per_box);
  for (int axis = 0; axis < 3; ++axis) {
    box_center_[axis][b] = box.center[axis];
    box_half_width_[axis][b] = box.half_width[axis];
  }
}

BlockSpan QuantizedLeaves::box_of(std::int32_t first, std::int32_t last) const {
  return around(first, last, false, [&](std::int32_t b, int axis) {
    return std::pair<int, int>(box_center_[axis][b], box_half_width_[axis][b]);
  });
}

BlockSpans QuantizedLeaves::boxes() const {
  return {{box_center_[0].data(), box_center_[1].data(), box_center_[2].data()},
          {box_half_width_[0].data(), box_half_width_[1].data(), box_half_width_[2].data()},
          number_.data()};
}

std::size_t QuantizedLeaves::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t bytes =
      bytes_of(number_) + bytes_of(origin) + bytes_of(points) + bytes_of(spans) + bytes_of(radii);
  for (int axis = 0; axis < 3; ++axis) bytes += bytes_of(box_center_[axis]) + bytes_of(box_half_width_[axis]);
  return bytes;
}

}  // namespace dch::detail
