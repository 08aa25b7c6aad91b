// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>

#include "simd/nearest_kernels.hpp"

namespace dch::detail {

/// Up to so many, what was found is put in order by counting what is nearer.
inline constexpr std::int32_t kMostRanked = 128;

/// Puts what was found in ascending order by keys that hold the bits of a squared distance and, in place of
/// the last ones, where it was found.
inline void rank_found(const NearestKernels& kernels, const NearestFound& found, const NearestFound& sorted) {
  std::int32_t key[kMostRanked + kChunk], rank[kMostRanked + kChunk];
  for (std::int32_t n = 0; n < found.count; ++n) {
    std::int32_t bits = 0;
    std::memcpy(&bits, &found.distance2[n], sizeof bits);
    key[n] = (bits & ~(kMostRanked - 1)) | n;
  }
  kernels.rank(key, found.count, rank);
  for (std::int32_t n = 0; n < found.count; ++n) {
    sorted.distance2[rank[n]] = found.distance2[n];
    sorted.slot[rank[n]] = found.slot[n];
  }
}

}  // namespace dch::detail
