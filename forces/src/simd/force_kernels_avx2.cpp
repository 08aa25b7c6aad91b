// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_avx2.hpp"
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

const ForceKernels& force_kernels_avx2() {
  static constexpr ForceKernels kKernels{lj_functions_of<Avx2Float>,       lj_functions_of<Avx2Double>,
                                         lj_pair_functions_of<Avx2Double>, mesh_kernels,
                                         born_kernels<Avx2Float>,          motion_kernels,
                                         all_pairs_kernels<Avx2Float>,     noise_kernels,
                                         bond_kernels<Avx2Double>,         angle_kernels<Avx2Double>,
                                         wave_kernels<Avx2Double>,         dissipative_kernels<Avx2Double>};
  return kKernels;
}

}  // namespace dch::detail
