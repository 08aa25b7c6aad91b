// SPDX-License-Identifier: MIT
//
// The loop that takes new positions into clusters; see cluster_loops.hpp. Nothing is fused, so that
// all sets round alike.
#pragma once

#include "clusters/simd/cluster_search_kernels.hpp"

namespace dch::detail {
namespace {

using FourDoubles = double __attribute__((vector_size(32)));
using EightInts = std::int32_t __attribute__((vector_size(32)));

inline void put_four(const FourDoubles& v, double* to) {
  for (int k = 0; k < 4; ++k) to[k] = v[k];
}

/// The nearest integers modulo 2^32: the last bits of a sum with a number near 1.5 x 2^52.
inline void round_four(const FourDoubles& sum, std::int32_t* to) {
  const EightInts bits = __builtin_bit_cast(EightInts, sum);
  // As wide as registers are, else compilers take the vector apart.
  const EightInts last = __builtin_shufflevector(bits, bits, 0, 2, 4, 6, 0, 2, 4, 6);
  for (int k = 0; k < 4; ++k) to[k] = last[k];
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
    const auto stays = (moved2 < task.safe2) & (x * x + y * y + z * z < task.farthest2);
    if ((stays[0] & stays[1] & stays[2] & stays[3]) == 0) {
      far[found++] = c;
      continue;
    }
    put_four(x, at.x);
    put_four(y, at.y);
    put_four(z, at.z);
    ClusterUnits& rounded = task.at_in_units[c];
    const Vec3 from = task.origin_in_units[task.origin_of[c]];
    round_four(task.per_unit * x + from.x, rounded.x);
    round_four(task.per_unit * y + from.y, rounded.y);
    round_four(task.per_unit * z + from.z, rounded.z);
  }
  return found;
}

}  // namespace
}  // namespace dch::detail
