// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_avx512.hpp"
#include "simd/contact_kernels_sets.hpp"
#include "simd/contact_loops.hpp"

namespace dch::detail {

const ContactKernels& contact_kernels_avx512() {
  static constexpr ContactKernels kKernels = contact_kernels_of<Avx512Double>;
  return kKernels;
}

}  // namespace dch::detail
