// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_portable.hpp"
#include "simd/contact_kernels_sets.hpp"
#include "simd/contact_loops.hpp"

namespace dch::detail {

const ContactKernels& contact_kernels_portable() {
  static constexpr ContactKernels kKernels = contact_kernels_of<PortableVector<double>>;
  return kKernels;
}

}  // namespace dch::detail
