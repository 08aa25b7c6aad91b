// SPDX-License-Identifier: MIT
#pragma once

#include "simd/embedded_kernels.hpp"

namespace dch::detail {

const EmbeddedKernels& embedded_kernels_portable();
#ifdef DCH_X86_KERNELS
const EmbeddedKernels& embedded_kernels_sse42();
const EmbeddedKernels& embedded_kernels_avx2();
const EmbeddedKernels& embedded_kernels_avx512();
#endif
#ifdef DCH_NEON_KERNELS
const EmbeddedKernels& embedded_kernels_neon();
#endif

}  // namespace dch::detail
