// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_neon.hpp"
#include "simd/contact_kernels_sets.hpp"
#include "simd/contact_loops.hpp"

namespace dch::detail {

const ContactKernels& contact_kernels_neon() {
  static constexpr ContactKernels kKernels = contact_kernels_of<NeonDouble>;
  return kKernels;
}

}  // namespace dch::detail
