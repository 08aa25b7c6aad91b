// SPDX-License-Identifier: MIT
#pragma once

#include "simd/contact_kernels.hpp"

namespace dch::detail {

const ContactKernels& contact_kernels_portable();
#ifdef DCH_X86_KERNELS
const ContactKernels& contact_kernels_sse42();
const ContactKernels& contact_kernels_avx2();
const ContactKernels& contact_kernels_avx512();
#endif
#ifdef DCH_NEON_KERNELS
const ContactKernels& contact_kernels_neon();
#endif

}  // namespace dch::detail
