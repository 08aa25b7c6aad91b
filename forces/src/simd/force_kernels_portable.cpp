// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_portable.hpp"
#include "simd/all_pairs_loops.hpp"
#include "simd/angle_kernels_loops.hpp"
#include "simd/bond_kernels_loops.hpp"
#include "simd/born_loops.hpp"
#include "simd/force_kernels_sets.hpp"
#include "simd/lj_pair_kernels_loops.hpp"
#include "simd/mesh_loops.hpp"
#include "simd/motion_loops.hpp"
#include "simd/noise_loops.hpp"
#include "simd/waves_loops.hpp"

namespace dch::detail {

const ForceKernels& force_kernels_portable() {
  static constexpr ForceKernels kKernels{
      lj_functions_of<Portable<float>>,       lj_functions_of<Portable<double>>,
      lj_pair_functions_of<Portable<double>>, mesh_kernels,
      born_kernels<Portable<float>>,          motion_kernels,
      all_pairs_kernels<Portable<float>>,     noise_kernels,
      bond_kernels<Portable<double>>,         angle_kernels<Portable<double>>,
      wave_kernels<Portable<double>>};
  return kKernels;
}

}  // namespace dch::detail
