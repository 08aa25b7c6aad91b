// SPDX-License-Identifier: MIT
#include "simd/bin_points_loops.hpp"

namespace dch::detail {

bool bin_points_portable(const BrickBins& bins, const double* positions, std::int32_t count,
                         std::int32_t* bin, std::int16_t* rounded) {
  return bin_points_loops<2>(bins, positions, count, bin, rounded);
}

BinPoints bin_points(InstructionSet set) {
#ifdef DCH_X86_KERNELS
  if (set == InstructionSet::avx512) return bin_points_avx512;
  if (set == InstructionSet::avx2) return bin_points_avx2;
#endif
  static_cast<void>(set);  // the baselines of compilers are next to SSE4.2 and NEON here
  return bin_points_portable;
}

}  // namespace dch::detail
