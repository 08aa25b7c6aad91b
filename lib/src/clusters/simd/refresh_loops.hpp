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

/// Coordinates of the four slots of a cluster.
struct FourPlaces {
  FourDoubles x, y, z;
};

inline FourPlaces four_places(const ClusterOfFour<double>& of) {
  return {FourDoubles{of.x[0], of.x[1], of.x[2], of.x[3]}, FourDoubles{of.y[0], of.y[1], of.y[2], of.y[3]},
          FourDoubles{of.z[0], of.z[1], of.z[2], of.z[3]}};
}

/// As they are given. Those of a cluster that comes later are asked for meanwhile: they stand anywhere.
inline FourPlaces given_places(const RefreshTask& task, std::int32_t cluster) {
  constexpr std::int32_t kClustersAhead = 8;
  const std::int32_t* const slot = task.particle + 4 * std::int64_t{cluster};
  if (cluster + kClustersAhead < task.last) {
    for (int k = 0; k < 4; ++k) {
      const std::int32_t i = slot[4 * kClustersAhead + k];
      if (i >= 0) __builtin_prefetch(task.positions + i);
    }
  }
  const Vec3* of[4];
  for (int k = 0; k < 4; ++k) of[k] = task.positions + slot[slot[k] < 0 ? 0 : k];
  return {FourDoubles{of[0]->x, of[1]->x, of[2]->x, of[3]->x},
          FourDoubles{of[0]->y, of[1]->y, of[2]->y, of[3]->y},
          FourDoubles{of[0]->z, of[1]->z, of[2]->z, of[3]->z}};
}

inline FourPlaces from_origin(const RefreshTask& task, std::int32_t cluster, const FourPlaces& at) {
  const Vec3 origin = task.origin[task.origin_of[cluster]];
  return {at.x - origin.x, at.y - origin.y, at.z - origin.z};
}

/// Whether the distance of each slot in both is less than that, squared; not for NaN.
inline bool all_within(const FourPlaces& a, const FourPlaces& b, double than2) {
  const FourDoubles dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
  const auto less = dx * dx + dy * dy + dz * dz < than2;
  return (less[0] & less[1] & less[2] & less[3]) != 0;
}

inline bool all_near_origin(const FourPlaces& a, double than2) {
  const auto less = a.x * a.x + a.y * a.y + a.z * a.z < than2;
  return (less[0] & less[1] & less[2] & less[3]) != 0;
}

inline void take(const RefreshTask& task, std::int32_t cluster, const FourPlaces& from) {
  ClusterOfFour<double>& at = task.at[cluster];
  put_four(from.x, at.x);
  put_four(from.y, at.y);
  put_four(from.z, at.z);
  ClusterUnits& rounded = task.at_in_units[cluster];
  const Vec3 origin = task.origin_in_units[task.origin_of[cluster]];
  round_four(task.per_unit * from.x + origin.x, rounded.x);
  round_four(task.per_unit * from.y + origin.y, rounded.y);
  round_four(task.per_unit * from.z + origin.z, rounded.z);
}

/// See ClusterSearchKernels::refresh. A template, so that each file that includes this has its own.
template <class S>
std::int32_t refresh_clusters(const RefreshTask& task, std::int32_t* far) {
  std::int32_t found = 0;
  for (std::int32_t c = task.first; c < task.last; ++c) {
    const FourPlaces now = from_origin(task, c, given_places(task, c));
    if (all_within(now, four_places(task.at[c]), task.safe2) && all_near_origin(now, task.farthest2)) {
      take(task, c, now);
    } else {
      far[found++] = c;
    }
  }
  return found;
}

/// See ClusterSearchKernels::follow.
template <class S>
FollowedClusters follow_clusters(const FollowTask& task, std::int32_t* away) {
  FollowedClusters found;
  for (std::int32_t c = task.refresh.first; c < task.refresh.last; ++c) {
    FourPlaces given = given_places(task.refresh, c);
    if (const std::int32_t s = task.shift_of[c]; s >= 0) {
      const FourPlaces by = four_places(task.shift[s]);
      given = {given.x + by.x, given.y + by.y, given.z + by.z};
    }
    const FourPlaces now = from_origin(task.refresh, c, given);
    const FourPlaces place = four_places(task.place[c]);
    if (!all_within(now, place, task.within2)) {
      away[found.away++] = c;
      // Those near their places are near their origins.
      if (!all_within(now, place, task.refresh.safe2) || !all_near_origin(now, task.refresh.farthest2)) {
        ++found.uncertain;
        continue;
      }
    }
    take(task.refresh, c, now);
  }
  return found;
}

}  // namespace
}  // namespace dch::detail
