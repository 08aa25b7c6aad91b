// SPDX-License-Identifier: MIT
#pragma once

#include "cluster_kernels.hpp"

namespace dch::detail {

const ClusterKernels& cluster_kernels_portable();
#ifdef DCH_X86_KERNELS
const ClusterKernels& cluster_kernels_sse42();
const ClusterKernels& cluster_kernels_avx2();
const ClusterKernels& cluster_kernels_avx512();
#endif

}  // namespace dch::detail
