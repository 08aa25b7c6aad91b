// SPDX-License-Identifier: MIT
#include "leaves/quantized_leaves.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include "base/resize.hpp"
#include "leaves/block_offsets.hpp"
#include "leaves/leaf_frame.hpp"
#include "leaves/own_blocks.hpp"
#include "leaves/rounding.hpp"

namespace dch::detail {
namespace {

/// Coordinates along three axes, and a fourth number that does not matter: what registers hold on every
/// processor.
using Axes __attribute__((vector_size(16))) = float;
using Bits __attribute__((vector_size(16))) = std::int32_t;
using Integers __attribute__((vector_size(8))) = std::int16_t;

inline Axes lower(const MeasuredLeaves::Corners& corners) {
  Axes low;
  std::memcpy(&low, &corners, sizeof low);
  return low;
}
inline Axes upper(const MeasuredLeaves::Corners& corners) {
  static_assert(sizeof corners == 6 * sizeof(float));
  Axes high;
  std::memcpy(&high, reinterpret_cast<const char*>(&corners) + 2 * sizeof(float), sizeof high);
  return __builtin_shufflevector(high, high, 1, 2, 3, 3);
}
/// As rounded() does it with each.
inline Integers rounded_axes(Axes v) {
  const Axes shifted = v + 0x1.8p23f;
  Bits bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  return __builtin_convertvector(bits, Integers);
}

/// Holds the rounded points between the corners, relative to an origin, and the corners themselves.
inline BlockSpan span_around(Axes low, Axes high, Axes origin, float per_unit) {
  const Axes first = (low - origin) * per_unit, last = (high - origin) * per_unit;
  const Integers center = rounded_axes(0.5f * (first + last));
  const Integers half_width = rounded_axes(0.5f * (last - first)) + static_cast<std::int16_t>(2);
  BlockSpan span;
  std::memcpy(span.center, &center, sizeof span.center);
  std::memcpy(span.half_width, &half_width, sizeof span.half_width);
  return span;
}

}  // namespace

void QuantizedLeaves::quantize(const MeasuredLeaves& measured, const LabelledLeaves& labelled,
                               const ListUnits& to_units, Span<const Vec3> centers, Executor* executor,
                               const RoundPoints& round_points) {
  units = to_units;
  per_unit = {1 / units.point, 1 / units.box};
  const auto all = static_cast<std::size_t>(measured.blocks);
  resize_closely(points, all);
  resize_closely(spans, all);
  resize_closely(radii, labelled.radii.size());
  resize_closely(origin, measured.leaves.size());
  for (int axis = 0; axis < 3; ++axis) {
    resize_closely(box_center_[axis], all + kChunk);
    resize_closely(box_half_width_[axis], all + kChunk);
  }
  if (number_.size() < all + kChunk) {
    resize_closely(number_, all + kChunk);
    std::iota(number_.begin(), number_.end(), 0);
  }
  for_ranges(executor, static_cast<std::int32_t>(origin.size()), [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t k = first; k < last; ++k) {
      const MeasuredLeaves::Leaf& leaf = measured.leaves[k];
      origin[k] = frame_origin(centers[k], leaf.middle, units.point);
      BlockUnits in_leaf{{}, static_cast<float>(per_unit.point)};
      for (int axis = 0; axis < 3; ++axis) in_leaf.origin[axis] = static_cast<float>(origin[k][axis]);
      if (round_points) round_points(k, in_leaf, points.data());
      for (std::int32_t b = leaf.first_block; b < leaf.first_block + leaf.blocks; ++b) {
        if (!round_points) round_offsets(measured.offsets[b], in_leaf, points[b]);
        for (int lane = 0; lane < kBlock && !radii.empty(); ++lane)
          radii[b][lane] = rounded(labelled.radii[b][lane] * in_leaf.per_unit);
        quantize_boxes(measured.corners[b], in_leaf, b);
      }
    }
  });
}

void QuantizedLeaves::quantize_boxes(const MeasuredLeaves::Corners& corners, const BlockUnits& to_units,
                                     std::int32_t b) {
  const Axes low = lower(corners), high = upper(corners);
  const Axes of_leaf{to_units.origin[0], to_units.origin[1], to_units.origin[2]}, center{};
  spans[b] = span_around(low, high, of_leaf, to_units.per_unit);
  const BlockSpan box = span_around(low, high, center, static_cast<float>(per_unit.box));
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
