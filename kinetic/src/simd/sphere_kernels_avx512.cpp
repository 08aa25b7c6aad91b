// SPDX-License-Identifier: MIT
#include "simd/sphere_kernels_loops.hpp"

namespace dch::kinetic {

const SphereKernels& sphere_kernels_avx512() {
  static constexpr SphereKernels kKernels{contact_times, find_touching};
  return kKernels;
}

}  // namespace dch::kinetic
