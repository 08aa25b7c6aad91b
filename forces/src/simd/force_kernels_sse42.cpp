// SPDX-License-Identifier: MIT
#include "clusters/simd/vectors_sse42.hpp"
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

const ForceKernels& force_kernels_sse42() {
  static constexpr ForceKernels kKernels{lj_functions_of<SseFloat>,       lj_functions_of<SseDouble>,
                                         lj_pair_functions_of<SseDouble>, mesh_kernels,
                                         born_kernels<SseFloat>,          motion_kernels,
                                         all_pairs_kernels<SseFloat>,     noise_kernels,
                                         bond_kernels<SseDouble>,         angle_kernels<SseDouble>,
                                         wave_kernels<SseDouble>,         dissipative_kernels<SseDouble>};
  return kKernels;
}

}  // namespace dch::detail
