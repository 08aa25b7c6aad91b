// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_portable.hpp"
#include "simd/embedded_kernels_sets.hpp"
#include "simd/embedded_loops.hpp"

namespace dch::detail {

const EmbeddedKernels& embedded_kernels_portable() {
  static constexpr EmbeddedKernels kKernels = embedded_kernels_of<PortableVector<double>>;
  return kKernels;
}

}  // namespace dch::detail
