// SPDX-License-Identifier: MIT
#include "simd/bin_points_loops.hpp"

namespace dch::detail {

bool bin_points_avx512(const BrickBins& bins, const double* positions, std::int32_t count, std::int32_t* bin,
                       std::int16_t* rounded) {
  return bin_points_loops<8>(bins, positions, count, bin, rounded);
}

}  // namespace dch::detail
