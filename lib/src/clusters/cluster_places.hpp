// SPDX-License-Identifier: MIT
//
// Places of the slots of a cluster, in double precision and in units.
#pragma once

#include <cmath>
#include <cstdint>

#include <dch/base/vec3.hpp>
#include <dch/clusters/cluster_pairs.hpp>
#include <dch/geometry/box.hpp>

namespace dch::detail {

inline constexpr std::int32_t kPadding = -1;

inline Vec3 slot_of(const ClusterOfFour<double>& cluster, int slot) {
  return {cluster.x[slot], cluster.y[slot], cluster.z[slot]};
}

inline void put_slot(Vec3 at, int slot, ClusterOfFour<double>& cluster) {
  cluster.x[slot] = at.x;
  cluster.y[slot] = at.y;
  cluster.z[slot] = at.z;
}

/// The nearest integer modulo 2^32.
inline std::int32_t nearest_unit(double units) {
  if (!(std::abs(units) < 0x1p51)) units = std::remainder(units, 0x1p32);  // slow, and exact
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::llrint(units)));
}

/// As the kernels do.
inline void round_cluster(const ClusterOfFour<double>& at, Vec3 origin, double per_unit, ClusterUnits& to) {
  const auto last_bits = [](double sum) { return nearest_unit(sum - 0x1.8p52); };
  for (int slot = 0; slot < ClusterPairs::kSlots; ++slot) {
    to.x[slot] = last_bits(per_unit * at.x[slot] + origin.x);
    to.y[slot] = last_bits(per_unit * at.y[slot] + origin.y);
    to.z[slot] = last_bits(per_unit * at.z[slot] + origin.z);
  }
}

/// Of how far a particle moves less in the image that it is in.
inline double safe_distance2(const Box& box) {
  const double safe = 0.25 * box.min_height();
  return safe * safe;
}

}  // namespace dch::detail
