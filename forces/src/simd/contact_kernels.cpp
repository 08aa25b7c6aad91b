// SPDX-License-Identifier: MIT
#include "simd/contact_kernels_sets.hpp"

namespace dch::detail {

const ContactKernels& contact_kernels(InstructionSet set) {
  switch (set) {
#ifdef DCH_X86_KERNELS
    case InstructionSet::sse42:
      return contact_kernels_sse42();
    case InstructionSet::avx2:
      return contact_kernels_avx2();
    case InstructionSet::avx512:
      return contact_kernels_avx512();
#endif
#ifdef DCH_NEON_KERNELS
    case InstructionSet::neon:
      return contact_kernels_neon();
#endif
    default:
      return contact_kernels_portable();
  }
}

}  // namespace dch::detail
