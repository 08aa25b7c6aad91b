// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_avx512.hpp"
#include "simd/form_kernels_loops.hpp"
#include "simd/form_kernels_sets.hpp"
#include "simd/forms/knots_avx512.hpp"

namespace dch::detail {

const FormKernels& form_kernels_avx512() {
  static constexpr FormKernels kKernels = form_kernels_of<Avx512Float, Avx512Double>;
  return kKernels;
}

}  // namespace dch::detail
