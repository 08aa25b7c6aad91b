// SPDX-License-Identifier: MIT
#pragma once

#include "simd/form_kernels.hpp"

namespace dch::detail {

const FormKernels& form_kernels_portable();
#ifdef DCH_X86_KERNELS
const FormKernels& form_kernels_sse42();
const FormKernels& form_kernels_avx2();
const FormKernels& form_kernels_avx512();
#endif
#ifdef DCH_NEON_KERNELS
const FormKernels& form_kernels_neon();
#endif

}  // namespace dch::detail
