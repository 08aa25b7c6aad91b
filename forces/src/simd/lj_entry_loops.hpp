// SPDX-License-Identifier: MIT
//
// Lennard-Jones and Coulomb forces of one entry, over vector types; see cluster_loops.hpp.
#pragma once

#include "simd/lj_terms_loops.hpp"

namespace dch::detail {
namespace {

/// Displacements, in units, squared distances and their inverse of an entry's pairs; the latter are 0 where
/// nothing acts.
template <class S>
struct Separations {
  Coordinates<S> d;
  typename S::V r2[S::kRegisters], s[S::kRegisters];
};

/// Charges of a row's cluster and its coefficients of dispersion, for the pairs of each register.
template <class S>
struct RowCharges {
  typename S::V of_i[S::kRegisters], dispersion_of_i[S::kRegisters];
};

/// Which registers of an entry have pairs.
enum class Half { both, lower, upper };
template <class S>
constexpr int first_register(Half half) {
  return half == Half::upper ? S::kRegisters / 2 : 0;
}
template <class S>
constexpr int end_of_registers(Half half) {
  return half == Half::lower ? S::kRegisters / 2 : S::kRegisters;
}

template <class S, LjParameters kParameters, class Kind, Half kHalf, class J>
Separations<S> measure(const LjTask<typename S::Real>& task, const ClusterPairs::Row& row, const Places<S>& i,
                       const J& beside, PairCoefficients<S, kParameters>& coefficient,
                       const Constants<S>& constants) {
  using V = typename S::V;
  const auto j = beside.places(task, row);
  coefficient.choose_j(beside);
  Separations<S> found;
  for (int p = first_register<S>(kHalf); p < end_of_registers<S>(kHalf); ++p) {
    const V dx = S::difference(j.x, i.x[p]), dy = S::difference(j.y, i.y[p]), dz = S::difference(j.z, i.z[p]);
    V r2 = in_length2<S>(S::madd(dx, dx, S::madd(dy, dy, S::mul(dz, dz))), constants.unit2);
    if constexpr (Kind::kActsAtZero) r2 = S::max(r2, S::set1(kNearZero<typename S::Real>));
    found.d.x[p] = dx;
    found.d.y[p] = dy;
    found.d.z[p] = dz;
    found.r2[p] = r2;
    V reach2;
    if constexpr (Kind::kHasOneCutoff || PairCoefficients<S, kParameters>::kMixes)
      reach2 = coefficient.common_cutoff2();
    else
      reach2 = coefficient(kCutoff2, p);
    if constexpr (Kind::kHasTwoCutoffs && !PairCoefficients<S, kParameters>::kMixes)
      reach2 = S::max(reach2, coefficient(kCoulombCutoff2, p));
    found.s[p] = S::keep(S::less(r2, reach2, beside.mask(), p), S::inverse(r2));
  }
  return found;
}

template <class S>
struct RowSums {
  Coordinates<S> force;
  typename S::V energy, coulomb_energy, virial[6];
};

/// Whether forces on clusters J are kept lane by lane, in memory, while rows are computed. Where one register
/// holds all 16 pairs this takes a fused operation for each axis; to sum up over cluster I, which is put off
/// to the end, takes nine more, and shuffles among them.
template <class S>
constexpr bool kWantsLanes = S::kRegisters == 1;

/// Adds force / r times displacements to an entry's lanes and to what the row has summed up.
template <class S, class J>
void add_to_lanes(typename S::V force, const Coordinates<S>& d, Coordinates<S>& sum, const J& beside,
                  typename S::Real* lanes) {
  static_assert(S::kRegisters == 1);
  sum.x[0] = S::madd(force, d.x[0], sum.x[0]);
  sum.y[0] = S::madd(force, d.y[0], sum.y[0]);
  sum.z[0] = S::madd(force, d.z[0], sum.z[0]);
  beside.add(force, d, lanes);
}

/// Adds the forces of an entry to those of its cluster J, and to what the row has summed up.
template <class S, LjParameters kParameters, bool kSums, class Kind, Half kHalf, class J>
void apply(const LjTask<typename S::Real>& task, const J& beside, const Separations<S>& separation,
           PairCoefficients<S, kParameters>& coefficient, const RowCharges<S>& charges,
           const Constants<S>& constants, RowSums<S>& sum) {
  using V = typename S::V;
  coefficient.choose_j(beside);
  Coordinates<S> force;
  if constexpr (kHalf != Half::both)
    for (int p = 0; p < S::kRegisters; ++p) force.x[p] = force.y[p] = force.z[p] = S::zero();
  for (int p = first_register<S>(kHalf); p < end_of_registers<S>(kHalf); ++p) {
    const V dx = separation.d.x[p], dy = separation.d.y[p], dz = separation.d.z[p], s = separation.s[p];
    Products<S> products{S::zero(), S::zero()};
    if constexpr (Kind::kHasCharges) products.charge = S::mul(charges.of_i[p], beside.repeat(task.charge));
    if constexpr (Kind::kHasDispersion)
      products.dispersion = S::mul(charges.dispersion_of_i[p], beside.repeat(task.dispersion));
    const PairTerms<S> terms =
        Kind::template terms<S, kSums>(coefficient, p, separation.r2[p], s, products, constants);
    // The force on J, which the displacement points to.
    force.x[p] = S::mul(terms.force, dx);
    force.y[p] = S::mul(terms.force, dy);
    force.z[p] = S::mul(terms.force, dz);
    if constexpr (kWantsLanes<S>) {
      add_to_lanes<S>(terms.force, separation.d, sum.force, beside, task.lanes);
    } else {
      sum.force.x[p] = S::add(sum.force.x[p], force.x[p]);
      sum.force.y[p] = S::add(sum.force.y[p], force.y[p]);
      sum.force.z[p] = S::add(sum.force.z[p], force.z[p]);
    }
    if constexpr (kSums) {
      sum.energy = S::add(sum.energy, terms.energy);
      if constexpr (Kind::kHasCharges) sum.coulomb_energy = S::add(sum.coulomb_energy, terms.coulomb_energy);
      const V x = in_length<S>(dx, constants.unit), y = in_length<S>(dy, constants.unit),
              z = in_length<S>(dz, constants.unit);
      sum.virial[0] = S::madd(x, force.x[p], sum.virial[0]);
      sum.virial[1] = S::madd(y, force.y[p], sum.virial[1]);
      sum.virial[2] = S::madd(z, force.z[p], sum.virial[2]);
      sum.virial[3] = S::madd(x, force.y[p], sum.virial[3]);
      sum.virial[4] = S::madd(x, force.z[p], sum.virial[4]);
      sum.virial[5] = S::madd(y, force.z[p], sum.virial[5]);
    }
  }
  if constexpr (!kWantsLanes<S>) S::add_over_i(force, task.force[beside.cluster()]);
}

}  // namespace
}  // namespace dch::detail
