// SPDX-License-Identifier: MIT
#include "simd/list_kernels_sets.hpp"

namespace dch::detail {

const ListKernels& list_kernels(InstructionSet set) {
  switch (set) {
#ifdef DCH_X86_KERNELS
    case InstructionSet::sse42:
      return list_kernels_sse42();
    case InstructionSet::avx2:
      return list_kernels_avx2();
    case InstructionSet::avx512:
      return list_kernels_avx512();
#endif
#ifdef DCH_NEON_KERNELS
    case InstructionSet::neon:
      return list_kernels_neon();
#endif
    default:
      return list_kernels_portable();
  }
}

}  // namespace dch::detail
