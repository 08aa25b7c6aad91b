// SPDX-License-Identifier: MIT
#include "simd/lanes_avx512.hpp"
#include "simd/list_kernels_loops.hpp"
#include "simd/list_kernels_sets.hpp"

namespace dch::detail {

const ListKernels& list_kernels_avx512() {
  static constexpr ListKernels kKernels = kernels_of<Avx512>;
  return kKernels;
}

}  // namespace dch::detail
