// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_neon.hpp"
#include "simd/embedded_kernels_sets.hpp"
#include "simd/embedded_loops.hpp"

namespace dch::detail {

const EmbeddedKernels& embedded_kernels_neon() {
  static constexpr EmbeddedKernels kKernels = embedded_kernels_of<NeonDouble>;
  return kKernels;
}

}  // namespace dch::detail
