// SPDX-License-Identifier: MIT
#include "simd/embedded_kernels_sets.hpp"

namespace dch::detail {

const EmbeddedKernels& embedded_kernels(InstructionSet set) {
  switch (set) {
#ifdef DCH_X86_KERNELS
    case InstructionSet::sse42:
      return embedded_kernels_sse42();
    case InstructionSet::avx2:
      return embedded_kernels_avx2();
    case InstructionSet::avx512:
      return embedded_kernels_avx512();
#endif
#ifdef DCH_NEON_KERNELS
    case InstructionSet::neon:
      return embedded_kernels_neon();
#endif
    default:
      return embedded_kernels_portable();
  }
}

}  // namespace dch::detail
