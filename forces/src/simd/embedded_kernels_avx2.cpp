// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_avx2.hpp"
#include "simd/embedded_kernels_sets.hpp"
#include "simd/embedded_loops.hpp"
#include "simd/records_avx2.hpp"

namespace dch::detail {

const EmbeddedKernels& embedded_kernels_avx2() {
  static constexpr EmbeddedKernels kKernels = embedded_kernels_of<Avx2Double>;
  return kKernels;
}

}  // namespace dch::detail
