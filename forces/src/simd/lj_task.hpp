// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/clusters/cluster_pairs.hpp>

#include "clusters/simd/few_types.hpp"

namespace dch::detail {

/// Coefficients of the pairs of types, each array types x types, row-major, with room for kFewTypes at least:
/// with s = 1/r^2,
///   force / r = s^4 (force12 s^3 - force6),   energy = s^3 (energy12 s^3 - energy6) - energy_shift
/// where r^2 < cutoff2. Charges act where r^2 < coulomb_cutoff2.
template <class Real>
struct LjCoefficients {
  const Real *cutoff2, *force12, *force6, *energy12, *energy6, *energy_shift, *coulomb_cutoff2;
};

/// Which terms act: Lennard-Jones alone; with charges, whose energy is q_i q_j / r, what an Ewald sum leaves
/// of that, q_i q_j erfc(splitting r) / r, or that with a reaction field, q_i q_j (1/r + quadratic r^2 -
/// offset); and Lennard-Jones multiplied by a switching function, alone, with charges and their reaction
/// field, or with what an Ewald sum leaves. `ewald` takes erfc from a formula; the others of an
/// Ewald sum take it from a series. `ewald_dispersion` has what a lattice sum leaves of dispersion too. Where
/// there is a reaction field, a switch or a series, all pairs have one cutoff.
enum class ForceKind {
  lennard_jones,
  plain,
  ewald,
  reaction_field,
  switched,
  switched_reaction_field,
  ewald_series,
  switched_ewald,
  ewald_dispersion
};
inline constexpr int kForceKinds = 9;

constexpr bool has_reaction_field(ForceKind kind) {
  return kind == ForceKind::reaction_field || kind == ForceKind::switched_reaction_field;
}
constexpr bool has_ewald(ForceKind kind) {
  return kind == ForceKind::ewald || kind == ForceKind::ewald_series || kind == ForceKind::switched_ewald ||
         kind == ForceKind::ewald_dispersion;
}
constexpr bool has_dispersion(ForceKind kind) { return kind == ForceKind::ewald_dispersion; }
constexpr bool has_charges(ForceKind kind) {
  return kind == ForceKind::plain || has_ewald(kind) || has_reaction_field(kind);
}
constexpr bool is_switched(ForceKind kind) {
  return kind == ForceKind::switched || kind == ForceKind::switched_reaction_field ||
         kind == ForceKind::switched_ewald;
}
/// Whether all pairs and charges have the same cutoff.
constexpr bool has_one_cutoff(ForceKind kind) {
  return has_reaction_field(kind) || is_switched(kind) || kind == ForceKind::ewald_series ||
         has_dispersion(kind);
}
/// Whether charges may have a cutoff of their own.
constexpr bool has_two_cutoffs(ForceKind kind) { return has_charges(kind) && !has_one_cutoff(kind); }

/// Where sigma and epsilon come from: they are the same for all pairs, stand in a table of pairs of types, or
/// are mixed from those of the particles.
enum class LjParameters { one_type, by_type, by_particle };

/// What a kernel finds: forces alone, sums of energies and virials of all pairs too, or those and the same
/// tallied by particle.
enum class Wanted { forces, sums, tallies };
inline constexpr int kWanted = 3;

/// Numbers of a particle that are tallied: energy, that of charges, the virial's xx, yy, zz, xy, xz, yz.
inline constexpr int kTallied = 8, kTallyOfCharges = 1, kTallyOfVirial = 2;
/// The numbers of a cluster's four slots, side by side.
inline constexpr std::ptrdiff_t kTalliedOfCluster = 4 * kTallied;

/// How many terms of EwaldSeries a precision has.
template <class Real>
inline constexpr int kEwaldTerms = sizeof(Real) == 4 ? 14 : 26;

/// How many numbers a form of PairPotential, and its charges, may have for all pairs.
inline constexpr int kNumbersOfForm = 7, kNumbersOfCharges = 3;
/// Squared distances below this are taken for it, where pairs at no distance act: its inverse is finite.
template <class Real>
inline constexpr Real kNearZero = sizeof(Real) == 4 ? Real(0x1p-100) : Real(0x1p-900);

/// What is the same for all pairs.
template <class Real>
struct LjConstants {
  Real splitting = 0;                    ///< of an Ewald sum [1/length]
  Real quadratic = 0, offset = 0;        ///< of a reaction field [1/length^3, 1/length]
  Real switch_from = 0, over_width = 0;  ///< where the switch begins; 1 / (cutoff - that)
  Real series_scale = 0;                 ///< EwaldSeries has powers of r^2 times this, less 1 [1/length^2]
  Real ewald_force[kEwaldTerms<Real>]{}, ewald_energy[kEwaldTerms<Real>]{};
  Real dispersion_force[kEwaldTerms<Real>]{};   ///< a DispersionSeries
  Real dispersion_energy[kEwaldTerms<Real>]{};  ///< the same, less its value at the cutoff
  Real over_cutoff2 = 0;                        ///< with dispersion [1/length^2]
  /// Of a form of PairPotential, and of its charges.
  Real of_form[kNumbersOfForm]{}, of_charges[kNumbersOfCharges]{};
  const Real *table_force = nullptr,
             *table_energy = nullptr;  ///< of TableForm and SplineForm, whose tables stand side by side
};

/// Lennard-Jones and Coulomb forces of cluster pairs.
template <class Real>
struct LjTask {
  const ClusterPairs::Row* rows;  ///< and one more
  std::int64_t row_count;
  const ClusterPairs::Entry* entries;
  ClusterPairs::EntryOrder order;
  const ClusterPairs::RowParts* parts;  ///< by row, unless as_found
  const ClusterPlace<Real>* at;
  const ClusterShift<Real>* shift;
  double unit;               ///< what displacements are in, hence forces; 1 in double precision [length]
  const std::int32_t* type;  ///< by slot
  std::int32_t types;
  LjCoefficients<Real> coefficients;
  const Real* half_sigma;    ///< by slot, aligned; null unless parameters are mixed
  const Real* root_epsilon;  ///< the same: the product of two is 4 epsilon of the pair
  const Real* charge;        ///< by slot, aligned; null without charges
  const Real* dispersion;    ///< coefficients by slot, aligned; null without a lattice sum of dispersion
  LjConstants<Real> constants;
  ClusterOfFour<Real>* force;  ///< by cluster; times unit; added to
  Real* lanes;              ///< kNumbersOfLanes by cluster, aligned, 0 before and after; null unless wanted
  ClusterPairs::Range own;  ///< clusters of the rows
  Span<const ClusterPairs::Range> later;  ///< others that the rows name
  double*
      tallies;  ///< kTalliedOfCluster by cluster, aligned; added to, the virial in units; null unless wanted
};

/// Forces of the 16 pairs of two clusters, not yet summed up to those of a cluster's four slots: x, y, z.
inline constexpr std::ptrdiff_t kNumbersOfLanes = 48;

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
  LjConstants<double> constants;
  Vec3* forces;                      ///< by particle; added to
  const std::int32_t* at = nullptr;  ///< by pair: whose position the second one has, where they are weighted
  const std::int32_t* pair_of_types = nullptr;  ///< by pair, then: where it stands in the matrices
  const std::int32_t* kind = nullptr;           ///< by pair, then
  const double *weight = nullptr, *charge_weight = nullptr;  ///< by kind
  double* tallies = nullptr;  ///< kTallied by particle; half of a pair is added to each; null unless wanted
};

/// Energies, and the virial sum of d f over pairs: xx, yy, zz, xy, xz, yz.
struct LjSums {
  double energy = 0, coulomb_energy = 0;
  double virial[6]{};
};

/// What is wanted, whose parameters and which terms, is decided when this is compiled. Functions that
/// nobody asks for are null: tallies of LennardJones, an Ewald sum by formula with parameters by particle,
/// and for pairs one by one a reaction field, a switch, a series and parameters by particle.
template <class Task>
struct LjFunctions {
  using Function = void (*)(const Task&, LjSums&);
  struct OfKind {
    Function of_parameters[3][kWanted];
  };
  OfKind of_kind[kForceKinds];
  bool wants_lanes = false;        ///< whether they use LjTask::lanes, and gain by entries that are joined
  bool leaves_out_halves = false;  ///< whether they gain by entries by halves

  Function choose(ForceKind kind, LjParameters parameters, Wanted wanted) const {
    return of_kind[static_cast<int>(kind)]
        .of_parameters[static_cast<int>(parameters)][static_cast<int>(wanted)];
  }
};

}  // namespace dch::detail
