// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_sse42.hpp"
#include "simd/embedded_kernels_sets.hpp"
#include "simd/embedded_loops.hpp"

namespace dch::detail {

const EmbeddedKernels& embedded_kernels_sse42() {
  static constexpr EmbeddedKernels kKernels = embedded_kernels_of<SseDouble>;
  return kKernels;
}

}  // namespace dch::detail
