// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_avx2.hpp"
#include "simd/form_kernels_loops.hpp"
#include "simd/form_kernels_sets.hpp"
#include "simd/forms/knots_avx2.hpp"

namespace dch::detail {

const FormKernels& form_kernels_avx2() {
  static constexpr FormKernels kKernels = form_kernels_of<Avx2Float, Avx2Double>;
  return kKernels;
}

}  // namespace dch::detail
