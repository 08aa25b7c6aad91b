// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_portable.hpp"
#include "simd/form_kernels_loops.hpp"
#include "simd/form_kernels_sets.hpp"

namespace dch::detail {

const FormKernels& form_kernels_portable() {
  static constexpr FormKernels kKernels = form_kernels_of<PortableVector<float>, PortableVector<double>>;
  return kKernels;
}

}  // namespace dch::detail
