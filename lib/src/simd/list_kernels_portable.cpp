// SPDX-License-Identifier: MIT
#include "simd/lanes_portable.hpp"
#include "simd/list_kernels_loops.hpp"
#include "simd/list_kernels_sets.hpp"

namespace dch::detail {

const ListKernels& list_kernels_portable() {
  static constexpr ListKernels kKernels = kernels_of<Portable>;
  return kKernels;
}

}  // namespace dch::detail
