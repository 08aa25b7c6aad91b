// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "simd/list_kernels.hpp"

namespace dch::detail {

/// Box around those of blocks [first, last), whose center and half width along an axis span_of(block, axis)
/// gives. Coordinates that wrap are taken relative to the first one.
template <class SpanOf>
BlockSpan around(std::int32_t first, std::int32_t last, bool wrap, const SpanOf& span_of) {
  BlockSpan span{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto origin = static_cast<std::uint16_t>(wrap ? span_of(first, axis).first : 0);
    int least = std::numeric_limits<int>::max(), most = std::numeric_limits<int>::lowest();
    for (std::int32_t b = first; b < last; ++b) {
      const auto [center, half_width] = span_of(b, axis);
      const int from_origin =
          static_cast<std::int16_t>(static_cast<std::uint16_t>(static_cast<std::uint16_t>(center) - origin));
      least = std::min(least, from_origin - half_width);
      most = std::max(most, from_origin + half_width);
    }
    span.center[axis] = static_cast<std::int16_t>(
        static_cast<std::uint16_t>(origin + static_cast<std::uint16_t>((least + most) / 2)));
    span.half_width[axis] = static_cast<std::int16_t>((most - least + 1) / 2);
  }
  return span;
}

/// Numbers of each lane of a block.
template <class T>
using OfLanes = std::array<T, kBlock>;

/// Blocks of points whose rows are wanted, with all that the rows take of them. Arrays begin with the first
/// block.
struct OwnBlocks {
  const BlockPoints* points = nullptr;
  const BlockSpan* spans = nullptr;  ///< hold the points
  const OfLanes<std::int32_t>* particle = nullptr;
  const OfLanes<std::int16_t>* tags = nullptr;  ///< what their cutoffs depend on; null if nothing
  const std::uint8_t* count = nullptr;          ///< points in each
  std::int32_t blocks = 0;
  bool are_candidates = true;  ///< whether their points are the first ones of the candidates near them
  bool wrap = false;           ///< whether coordinates wrap between them

  /// Box around blocks [first, last).
  BlockSpan span_of(std::int32_t first, std::int32_t last) const {
    return around(first, last, wrap, [this](std::int32_t b, int axis) {
      return std::pair<int, int>(spans[b].center[axis], spans[b].half_width[axis]);
    });
  }
  /// Largest tag in blocks [first, last); 0 if there are no tags.
  std::int16_t largest_tag(std::int32_t first, std::int32_t last) const {
    std::int16_t largest = 0;
    for (std::int32_t b = first; b < last && tags != nullptr; ++b)
      largest = std::max(largest, *std::max_element(tags[b].begin(), tags[b].end()));
    return largest;
  }
};

}  // namespace dch::detail
