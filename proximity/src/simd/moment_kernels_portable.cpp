// SPDX-License-Identifier: MIT
#include "simd/moment_kernels_loops.hpp"

namespace dch::detail {

const MomentKernel kMomentsPortable = sum_moments;

MomentKernel moment_kernel(InstructionSet set) {
#ifdef DCH_X86_KERNELS
  if (set == InstructionSet::avx512) return kMomentsAvx512;
  if (set == InstructionSet::avx2) return kMomentsAvx2;
#endif
  static_cast<void>(set);  // the baselines of compilers are next to SSE4.2 and NEON here
  return kMomentsPortable;
}

}  // namespace dch::detail
