// SPDX-License-Identifier: MIT
#pragma once

#include "simd/list_kernels.hpp"

namespace dch::detail {

const ListKernels& list_kernels_portable();
#ifdef DCH_X86_KERNELS
const ListKernels& list_kernels_sse42();
const ListKernels& list_kernels_avx2();
const ListKernels& list_kernels_avx512();
#endif
#ifdef DCH_NEON_KERNELS
const ListKernels& list_kernels_neon();
#endif

}  // namespace dch::detail
