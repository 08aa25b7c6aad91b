// SPDX-License-Identifier: MIT
#include "simd/sum_kernels_loops.hpp"

namespace dch::detail {

const SumKernels kSumPortable{translate, potential};

const SumKernels& sum_kernels(InstructionSet set) {
#ifdef DCH_X86_KERNELS
  if (set == InstructionSet::avx512) return kSumAvx512;
  if (set == InstructionSet::avx2) return kSumAvx2;
#endif
  static_cast<void>(set);  // the baselines of compilers are next to SSE4.2 and NEON here
  return kSumPortable;
}

}  // namespace dch::detail
