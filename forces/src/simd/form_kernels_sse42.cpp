// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_sse42.hpp"
#include "simd/form_kernels_loops.hpp"
#include "simd/form_kernels_sets.hpp"

namespace dch::detail {

const FormKernels& form_kernels_sse42() {
  static constexpr FormKernels kKernels = form_kernels_of<SseFloat, SseDouble>;
  return kKernels;
}

}  // namespace dch::detail
