// SPDX-License-Identifier: MIT
#include "simd/block_measure_loops.hpp"

namespace dch::detail {

bool measure_block_avx2(const BrickCell& cell, const double* positions, const std::int32_t* index,
                        std::int32_t count, const double* center, double covered2, double* wrapped,
                        float* offset, BlockExtremes& out) {
  return measure_block_loops(cell, positions, index, count, center, covered2, wrapped, offset, out);
}

bool offset_block_avx2(const BrickCell& cell, const double* positions, const std::int32_t* index,
                       std::int32_t count, const double* center, float* offset) {
  return offset_block_loops(cell, positions, index, count, center, offset);
}

void round_block_avx2(const double* positions, const std::int32_t* index, const double* center,
                      const BlockUnits& units, std::int16_t* rounded) {
  round_block_loops(positions, index, center, units, rounded);
}

}  // namespace dch::detail
