// SPDX-License-Identifier: MIT
//
// Many numbers of Ranmar at once. A sum needs none of the kRanmarShortLag - 1 before it, and the shift is
// known ahead, so that many follow in vectors from those before. All are integers: the same numbers as one by
// one.
#pragma once

#include <algorithm>
#include <cstring>

#include "simd/noise_task.hpp"
#include "simd/ranmar.hpp"

namespace dch::detail {
namespace {

inline constexpr std::size_t kRanmarLanes = 32;         ///< sums at once
inline constexpr std::size_t kRanmarMostNumbers = 384;  ///< that stay in the nearest cache
static_assert(kRanmarLanes <= kRanmarShortLag && kRanmarMostNumbers % kRanmarLanes == 0);

/// Shifts of the next numbers, in turn for each lane.
struct RanmarShifts {
  std::int32_t lane[kRanmarLanes];

  explicit RanmarShifts(std::int32_t shift) {
    for (std::int32_t& own : lane) own = shift = next_ranmar_shift(shift);
  }

  void next() {
    constexpr auto step =
        static_cast<std::int32_t>(std::int64_t{kRanmarShiftStep} * kRanmarLanes % kRanmarShiftModulus);
    for (std::int32_t& own : lane) {
      own -= step;
      own += own < 0 ? kRanmarShiftModulus : 0;
    }
  }
};

/// At most kRanmarMostNumbers.
inline void ranmar_batch(const RanmarTask& task, std::size_t first, std::size_t count) {
  std::int32_t sum[kRanmarLongLag + kRanmarMostNumbers], number[kRanmarMostNumbers];
  std::memcpy(sum, task.recent, kRanmarLongLag * sizeof(std::int32_t));
  RanmarShifts shifts(*task.shift);
  for (std::size_t from = 0; from < count; from += kRanmarLanes) {
    std::int32_t* const next = sum + kRanmarLongLag + from;
    for (std::size_t k = 0; k < kRanmarLanes; ++k) {
      next[k] = (sum[from + k] - sum[from + k + kRanmarLongLag - kRanmarShortLag]) & kRanmarMask;
      number[from + k] = (next[k] - shifts.lane[k]) & kRanmarMask;
    }
    if (from + kRanmarLanes < count) shifts.next();
  }
  for (std::size_t k = 0; k < count; ++k) task.numbers[first + k] = number[k] * 0x1p-24 - 0.5;
  std::memcpy(task.recent, sum + count, kRanmarLongLag * sizeof(std::int32_t));
  *task.shift = shifts.lane[(count - 1) % kRanmarLanes];
}

inline void noise_ranmar(const RanmarTask& task) {
  for (std::size_t first = 0; first < task.count; first += kRanmarMostNumbers)
    ranmar_batch(task, first, std::min(kRanmarMostNumbers, task.count - first));
}

}  // namespace
}  // namespace dch::detail
