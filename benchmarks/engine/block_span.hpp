// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "simd/list_kernels.hpp"

namespace dch::bench {

/// Box around points whose coordinates wrap: relative to the first of them.
inline detail::BlockSpan span_of(const detail::Candidates& points, std::int32_t count) {
  detail::BlockSpan span{};
  const std::int16_t* const axes[3] = {points.x, points.y, points.z};
  for (int axis = 0; axis < 3; ++axis) {
    const auto first = static_cast<std::uint16_t>(axes[axis][0]);
    int low = 0, high = 0;
    for (std::int32_t k = 1; k < count; ++k) {
      const int d = static_cast<std::int16_t>(static_cast<std::uint16_t>(axes[axis][k]) - first);
      low = std::min(low, d);
      high = std::max(high, d);
    }
    const int middle = (low + high) >> 1;
    span.center[axis] = static_cast<std::int16_t>(first + static_cast<std::uint16_t>(middle));
    span.half_width[axis] = static_cast<std::int16_t>(std::max(high - middle, middle - low));
  }
  return span;
}

}  // namespace dch::bench
