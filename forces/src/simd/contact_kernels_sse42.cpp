// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_sse42.hpp"
#include "simd/contact_kernels_sets.hpp"
#include "simd/contact_loops.hpp"

namespace dch::detail {

const ContactKernels& contact_kernels_sse42() {
  static constexpr ContactKernels kKernels = contact_kernels_of<SseDouble>;
  return kKernels;
}

}  // namespace dch::detail
