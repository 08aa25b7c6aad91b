// SPDX-License-Identifier: MIT
#include <cmath>

#include "simd/form_kernels_sets.hpp"

namespace dch::detail {

double logarithm_beside_one(double x) { return std::log1p(x); }

const FormKernels& form_kernels(InstructionSet set) {
  switch (set) {
#ifdef DCH_X86_KERNELS
    case InstructionSet::sse42:
      return form_kernels_sse42();
    case InstructionSet::avx2:
      return form_kernels_avx2();
    case InstructionSet::avx512:
      return form_kernels_avx512();
#endif
#ifdef DCH_NEON_KERNELS
    case InstructionSet::neon:
      return form_kernels_neon();
#endif
    default:
      return form_kernels_portable();
  }
}

}  // namespace dch::detail
