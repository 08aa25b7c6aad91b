// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_neon.hpp"
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

const ForceKernels& force_kernels_neon() {
  static constexpr ForceKernels kKernels{lj_functions_of<NeonFloat>,       lj_functions_of<NeonDouble>,
                                         lj_pair_functions_of<NeonDouble>, mesh_kernels,
                                         born_kernels<NeonFloat>,          motion_kernels,
                                         all_pairs_kernels<NeonFloat>,     noise_kernels,
                                         bond_kernels<NeonDouble>,         angle_kernels<NeonDouble>,
                                         wave_kernels<NeonDouble>,         dissipative_kernels<NeonDouble>};
  return kKernels;
}

}  // namespace dch::detail
