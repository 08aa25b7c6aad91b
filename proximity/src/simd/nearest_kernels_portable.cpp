// SPDX-License-Identifier: MIT
#include "simd/nearest_kernels_loops.hpp"

namespace dch::detail {

const NearestKernels kNearestPortable{select_blocks, search_blocks};

const NearestKernels& nearest_kernels(InstructionSet set) {
#ifdef DCH_X86_KERNELS
  if (set == InstructionSet::avx512) return kNearestAvx512;
  if (set == InstructionSet::avx2) return kNearestAvx2;
#endif
  static_cast<void>(set);  // the baseline of compilers for x86-64 is next to SSE4.2 here
  return kNearestPortable;
}

}  // namespace dch::detail
