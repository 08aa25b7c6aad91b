// SPDX-License-Identifier: MIT
#include "simd/block_measure_loops.hpp"

namespace dch::detail {

bool measure_block_avx2(const BrickCell& cell, const double* positions, const std::int32_t* index,
                        std::int32_t count, const double* center, double covered2, double* wrapped,
                        float* offset, BlockExtremes& out) {
  return measure_block_loops(cell, positions, index, count, center, covered2, wrapped, offset, out);
}

}  // namespace dch::detail
