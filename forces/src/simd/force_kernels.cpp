// SPDX-License-Identifier: MIT
#include "simd/force_kernels_sets.hpp"

namespace dch::detail {

const ForceKernels& force_kernels(InstructionSet set) {
  switch (set) {
#ifdef DCH_X86_KERNELS
    case InstructionSet::sse42:
      return force_kernels_sse42();
    case InstructionSet::avx2:
      return force_kernels_avx2();
    case InstructionSet::avx512:
      return force_kernels_avx512();
#endif
#ifdef DCH_NEON_KERNELS
    case InstructionSet::neon:
      return force_kernels_neon();
#endif
    default:
      return force_kernels_portable();
  }
}

}  // namespace dch::detail
