// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_neon.hpp"
#include "simd/form_kernels_loops.hpp"
#include "simd/form_kernels_sets.hpp"

namespace dch::detail {

const FormKernels& form_kernels_neon() {
  static constexpr FormKernels kKernels = form_kernels_of<NeonFloat, NeonDouble>;
  return kKernels;
}

}  // namespace dch::detail
