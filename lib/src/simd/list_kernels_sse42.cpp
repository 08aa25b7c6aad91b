// SPDX-License-Identifier: MIT
#include "simd/lanes_sse42.hpp"
#include "simd/list_kernels_loops.hpp"
#include "simd/list_kernels_sets.hpp"

namespace dch::detail {

const ListKernels& list_kernels_sse42() {
  static constexpr ListKernels kKernels = kernels_of<Sse42>;
  return kKernels;
}

}  // namespace dch::detail
