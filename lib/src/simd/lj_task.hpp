// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/cluster_pairs.hpp>

namespace dch::detail {

/// Tables of this many types fit into registers, which is faster than memory.
inline constexpr std::int32_t kFewTypes = 4;

/// Coefficients of the pairs of types, each array types x types, row-major, with room for kFewTypes at least:
/// with s = 1/r^2,
///   force / r = s^4 (force12 s^3 - force6),   energy = s^3 (energy12 s^3 - energy6) - energy_shift
/// where r^2 < cutoff2.
template <class Real>
struct LjCoefficients {
  const Real *cutoff2, *force12, *force6, *energy12, *energy6, *energy_shift;
};

/// Lennard-Jones forces of cluster pairs.
template <class Real>
struct LjTask {
  const ClusterPairs::Row* rows;  ///< and one more
  std::int64_t row_count;
  const ClusterPairs::Entry* entries;
  const ClusterOfFour<Real>* at;
  const ClusterShift<Real>* shift;
  const std::int32_t* type;  ///< by slot
  std::int32_t types;
  LjCoefficients<Real> coefficients;
  ClusterOfFour<Real>* force;  ///< by cluster; added to
};

/// Energy, and the virial sum of d f over pairs: xx, yy, zz, xy, xz, yz.
struct LjSums {
  double energy = 0;
  double virial[6]{};
};

/// Which sums are made, and for how many types, is decided when this is compiled.
template <class Real>
struct LjFunctions {
  using Function = void (*)(const LjTask<Real>&, LjSums&);
  Function one_type, one_type_sums;
  Function many_types, many_types_sums;

  Function choose(bool one, bool sums) const {
    return one ? (sums ? one_type_sums : one_type) : (sums ? many_types_sums : many_types);
  }
};

}  // namespace dch::detail
