// SPDX-License-Identifier: MIT
#pragma once

#include "simd/force_kernels.hpp"

namespace dch::detail {

const ForceKernels& force_kernels_portable();
#ifdef DCH_X86_KERNELS
const ForceKernels& force_kernels_sse42();
const ForceKernels& force_kernels_avx2();
const ForceKernels& force_kernels_avx512();
#endif
#ifdef DCH_NEON_KERNELS
const ForceKernels& force_kernels_neon();
#endif

}  // namespace dch::detail
