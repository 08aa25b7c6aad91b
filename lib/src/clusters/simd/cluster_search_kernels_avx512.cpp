// SPDX-License-Identifier: MIT
#include "clusters/simd/cluster_search_kernels_sets.hpp"
#include "clusters/simd/near_loops.hpp"
#include "clusters/simd/refresh_loops.hpp"
#include "clusters/simd/vectors_avx512.hpp"

namespace dch::detail {

const ClusterSearchKernels& cluster_search_kernels_avx512() {
  using Vectors = Avx512Float;
  static constexpr ClusterSearchKernels kKernels{near_boxes<Vectors>, near_clusters<Vectors>,
                                                 refresh_clusters<Vectors>};
  return kKernels;
}

}  // namespace dch::detail
