// SPDX-License-Identifier: MIT
#include "simd/lanes_avx2.hpp"
#include "simd/list_kernels_loops.hpp"
#include "simd/list_kernels_sets.hpp"

namespace dch::detail {

const ListKernels& list_kernels_avx2() {
  static constexpr ListKernels kKernels = kernels_of<Avx2>;
  return kKernels;
}

}  // namespace dch::detail
