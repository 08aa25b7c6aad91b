// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_portable.hpp"
#include "simd/all_pairs_loops.hpp"
#include "simd/angle_kernels_loops.hpp"
#include "simd/bond_kernels_loops.hpp"
#include "simd/born_loops.hpp"
#include "simd/dissipative_loops.hpp"
#include "simd/force_kernels_sets.hpp"
#include "simd/lj_pair_kernels_loops.hpp"
#include "simd/mesh_loops.hpp"
#include "simd/motion_loops.hpp"
#include "simd/noise_loops.hpp"
#include "simd/waves_loops.hpp"

namespace dch::detail {

const ForceKernels& force_kernels_portable() {
  static constexpr ForceKernels kKernels{
      lj_functions_of<PortableVector<float>>,       lj_functions_of<PortableVector<double>>,
      lj_pair_functions_of<PortableVector<double>>, mesh_kernels,
      born_kernels<PortableVector<float>>,          motion_kernels,
      all_pairs_kernels<PortableVector<float>>,     noise_kernels,
      bond_kernels<PortableVector<double>>,         angle_kernels<PortableVector<double>>,
      wave_kernels<PortableVector<double>>,         dissipative_kernels<PortableVector<double>>};
  return kKernels;
}

}  // namespace dch::detail
