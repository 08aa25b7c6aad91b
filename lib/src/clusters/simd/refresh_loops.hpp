// SPDX-License-Identifier: MIT
//
// The loop that takes new positions into clusters; see cluster_loops.hpp. Nothing is fused, so that
// all sets round alike.
#pragma once

#include "clusters/simd/cluster_search_kernels.hpp"

namespace dch::detail {
namespace {

using FourDoubles = double __attribute__((vector_size(32)));
using FourFloats = float __attribute__((vector_size(16)));

inline void put_four(const FourDoubles& v, double* to) {
  for (int k = 0; k < 4; ++k) to[k] = v[k];
}

/// To single precision, relative to their mean on the grid.
inline void round_four(const FourDoubles& v, double grid, float* to, float& center) {
  const double mean = 0.25 * ((v[0] + v[1]) + (v[2] + v[3]));
  const double middle = (mean + grid) - grid;
  center = static_cast<float>(middle);
  const FourFloats rounded = __builtin_convertvector(v - middle, FourFloats);
  for (int k = 0; k < 4; ++k) to[k] = rounded[k];
}

/// See ClusterKernels::refresh. A template, so that each file that includes this has its own.
template <class S>
std::int32_t refresh_clusters(const RefreshTask& task, std::int32_t* far) {
  std::int32_t found = 0;
  for (std::int32_t c = task.first; c < task.last; ++c) {
    const std::int32_t* const slot = task.particle + 4 * std::int64_t{c};
    const Vec3* of[4];
    for (int k = 0; k < 4; ++k) of[k] = task.positions + slot[slot[k] < 0 ? 0 : k];
    const Vec3 origin = task.origin[task.origin_of[c]];
    const FourDoubles x = FourDoubles{of[0]->x, of[1]->x, of[2]->x, of[3]->x} - origin.x;
    const FourDoubles y = FourDoubles{of[0]->y, of[1]->y, of[2]->y, of[3]->y} - origin.y;
    const FourDoubles z = FourDoubles{of[0]->z, of[1]->z, of[2]->z, of[3]->z} - origin.z;
    ClusterOfFour<double>& at = task.at[c];
    const FourDoubles dx = x - FourDoubles{at.x[0], at.x[1], at.x[2], at.x[3]},
                      dy = y - FourDoubles{at.y[0], at.y[1], at.y[2], at.y[3]},
                      dz = z - FourDoubles{at.z[0], at.z[1], at.z[2], at.z[3]};
    const FourDoubles moved2 = dx * dx + dy * dy + dz * dz;
    const auto stays = moved2 < task.safe2;
    if ((stays[0] & stays[1] & stays[2] & stays[3]) == 0) {
      far[found++] = c;
      continue;
    }
    put_four(x, at.x);
    put_four(y, at.y);
    put_four(z, at.z);
    ClusterOfFour<float>& rounded = task.at_float[c];
    round_four(x, task.grid, rounded.x, rounded.center[0]);
    round_four(y, task.grid, rounded.y, rounded.center[1]);
    round_four(z, task.grid, rounded.z, rounded.center[2]);
  }
  return found;
}

}  // namespace
}  // namespace dch::detail
