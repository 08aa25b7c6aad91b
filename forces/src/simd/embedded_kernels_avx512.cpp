// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_avx512.hpp"
#include "simd/embedded_kernels_sets.hpp"
#include "simd/embedded_loops.hpp"
#include "simd/records_avx512.hpp"

namespace dch::detail {

const EmbeddedKernels& embedded_kernels_avx512() {
  static constexpr EmbeddedKernels kKernels = embedded_kernels_of<Avx512Double>;
  return kKernels;
}

}  // namespace dch::detail
