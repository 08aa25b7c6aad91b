// SPDX-License-Identifier: MIT
#pragma once

#include "clusters/simd/cluster_search_kernels.hpp"

namespace dch::detail {

const ClusterSearchKernels& cluster_search_kernels_portable();
#ifdef DCH_X86_KERNELS
const ClusterSearchKernels& cluster_search_kernels_sse42();
const ClusterSearchKernels& cluster_search_kernels_avx2();
const ClusterSearchKernels& cluster_search_kernels_avx512();
#endif
#ifdef DCH_NEON_KERNELS
const ClusterSearchKernels& cluster_search_kernels_neon();
#endif

}  // namespace dch::detail
