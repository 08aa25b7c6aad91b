// SPDX-License-Identifier: MIT
#include "simd/lanes_neon.hpp"
#include "simd/list_kernels_loops.hpp"
#include "simd/list_kernels_sets.hpp"

namespace dch::detail {

const ListKernels& list_kernels_neon() {
  static constexpr ListKernels kKernels = kernels_of<Neon>;
  return kKernels;
}

}  // namespace dch::detail
