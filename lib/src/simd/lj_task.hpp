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
/// where r^2 < cutoff2. Charges act where r^2 < coulomb_cutoff2.
template <class Real>
struct LjCoefficients {
  const Real *cutoff2, *force12, *force6, *energy12, *energy6, *energy_shift, *coulomb_cutoff2;
};

/// How charges act: not at all, with energy q_i q_j / r, or with that part of it which is left to pairs by an
/// Ewald sum, q_i q_j erfc(splitting r) / r.
enum class CoulombKind { none, plain, ewald };
inline constexpr int kCoulombKinds = 3;

/// Lennard-Jones and Coulomb forces of cluster pairs.
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
  const Real* charge;          ///< by slot, aligned; null without charges
  Real splitting;              ///< of an Ewald sum [1/length]
  ClusterOfFour<Real>* force;  ///< by cluster; added to
};

/// The same forces of pairs one by one, in double precision.
struct LjPairTask {
  const std::int32_t *i, *j;
  std::int64_t first, last;  ///< of the pairs to compute
  const Vec3* positions;
  Vec3 shift;                ///< added to second particles
  const std::int32_t* type;  ///< by particle; null if there is one type
  std::int32_t types;
  LjCoefficients<double> coefficients;
  const double* charge;  ///< by particle; null without charges
  double charge_unit;    ///< what charges are multiplied by
  double splitting;      ///< of an Ewald sum [1/length]
  Vec3* forces;          ///< by particle; added to
};

/// Energies, and the virial sum of d f over pairs: xx, yy, zz, xy, xz, yz.
struct LjSums {
  double energy = 0, coulomb_energy = 0;
  double virial[6]{};
};

/// Which sums are made, for how many types and which charges, is decided when this is compiled.
template <class Task>
struct LjFunctions {
  using Function = void (*)(const Task&, LjSums&);
  struct OfKind {
    Function one_type, one_type_sums;
    Function many_types, many_types_sums;
  };
  OfKind of_kind[kCoulombKinds];

  Function choose(CoulombKind kind, bool one, bool sums) const {
    const OfKind& f = of_kind[static_cast<int>(kind)];
    return one ? (sums ? f.one_type_sums : f.one_type) : (sums ? f.many_types_sums : f.many_types);
  }
};

}  // namespace dch::detail
