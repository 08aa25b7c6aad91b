// SPDX-License-Identifier: MIT
#include "clusters/simd/cluster_search_kernels_sets.hpp"

namespace dch::detail {

const ClusterSearchKernels& cluster_search_kernels(InstructionSet set) {
  switch (set) {
#ifdef DCH_X86_KERNELS
    case InstructionSet::sse42:
      return cluster_search_kernels_sse42();
    case InstructionSet::avx2:
      return cluster_search_kernels_avx2();
    case InstructionSet::avx512:
      return cluster_search_kernels_avx512();
#endif
#ifdef DCH_NEON_KERNELS
    case InstructionSet::neon:
      return cluster_search_kernels_neon();
#endif
    default:
      return cluster_search_kernels_portable();
  }
}

}  // namespace dch::detail
