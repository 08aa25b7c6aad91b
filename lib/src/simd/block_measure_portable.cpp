// SPDX-License-Identifier: MIT
#include "simd/block_measure_loops.hpp"

namespace dch::detail {

bool measure_block_portable(const BrickCell& cell, const double* positions, const std::int32_t* index,
                            std::int32_t count, const double* center, double covered2, double* wrapped,
                            float* offset, BlockExtremes& out) {
  return measure_block_loops(cell, positions, index, count, center, covered2, wrapped, offset, out);
}

bool offset_block_portable(const BrickCell& cell, const double* positions, const std::int32_t* index,
                           std::int32_t count, const double* center, float* offset) {
  return offset_block_loops(cell, positions, index, count, center, offset);
}

void round_block_portable(const double* positions, const std::int32_t* index, const double* center,
                          const BlockUnits& units, std::int16_t* rounded) {
  round_block_loops(positions, index, center, units, rounded);
}

MeasureBlock measure_block(InstructionSet set) {
#ifdef DCH_X86_KERNELS
  if (set == InstructionSet::avx512) return measure_block_avx512;
  if (set == InstructionSet::avx2) return measure_block_avx2;
#endif
  static_cast<void>(set);  // the baselines of compilers are next to SSE4.2 and NEON here
  return measure_block_portable;
}

OffsetBlock offset_block(InstructionSet set) {
#ifdef DCH_X86_KERNELS
  if (set == InstructionSet::avx512) return offset_block_avx512;
  if (set == InstructionSet::avx2) return offset_block_avx2;
#endif
  static_cast<void>(set);
  return offset_block_portable;
}

RoundBlock round_block(InstructionSet set) {
#ifdef DCH_X86_KERNELS
  if (set == InstructionSet::avx512) return round_block_avx512;
  if (set == InstructionSet::avx2) return round_block_avx2;
#endif
  static_cast<void>(set);
  return round_block_portable;
}

}  // namespace dch::detail
