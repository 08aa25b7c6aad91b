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

/// Whether a kind of force has a number that is tallied.
template <class Kind>
constexpr bool has_number(int n) {
  return n != kTallyOfCharges || Kind::kHasCharges;
}

/// What the pairs of a row add: the forces on its cluster I, and numbers by lane as they are tallied, by
/// register too where they are.
template <class S, Wanted kFound>
struct RowSums {
  static constexpr int kSets = kFound == Wanted::tallies ? S::kRegisters : 1;
  using V = typename S::V;

  void clear() {
    for (int p = 0; p < S::kRegisters; ++p) force.x[p] = force.y[p] = force.z[p] = S::zero();
    for (auto& of_number : number)
      for (auto& v : of_number) v = S::zero();
  }
  /// Adds what is of all pairs to sums, and tallies what is of cluster I.
  template <class Kind>
  void give(const LjTask<typename S::Real>& task, std::int32_t cluster, LjSums& sums) const {
    if constexpr (kFound != Wanted::forces) {
      sums.energy += sum(0);
      if constexpr (Kind::kHasCharges) sums.coulomb_energy += sum(kTallyOfCharges);
      for (int k = 0; k < 6; ++k) sums.virial[k] += task.unit * sum(kTallyOfVirial + k);
    }
    if constexpr (kFound == Wanted::tallies)
      for (int n = 0; n < kTallied; ++n)
        if (has_number<Kind>(n))
          S::tally_over_j(number[n], task.tallies + kTalliedOfCluster * cluster + 4 * n);
  }

  Coordinates<S> force;
  V number[kTallied][kSets];

 private:
  double sum(int n) const {
    V all = number[n][0];
    for (int p = 1; p < kSets; ++p) all = S::add(all, number[n][p]);
    return S::sum(all);
  }
};

/// Adds what the pairs of register p have to the row's sums and, where numbers are tallied, to what cluster J
/// has of this entry.
template <class S, Wanted kFound, class Kind>
void add_numbers(const PairTerms<S>& terms, const Coordinates<S>& d, const Coordinates<S>& force, int p,
                 const Constants<S>& constants, RowSums<S, kFound>& sum, typename S::V* of_j) {
  using V = typename S::V;
  const V x = in_length<S>(d.x[p], constants.unit), y = in_length<S>(d.y[p], constants.unit),
          z = in_length<S>(d.z[p], constants.unit);
  const V fx = force.x[p], fy = force.y[p], fz = force.z[p];
  if constexpr (kFound == Wanted::tallies) {
    const auto add = [&](int n, V v) {
      sum.number[n][p] = S::add(sum.number[n][p], v);
      of_j[n] = S::add(of_j[n], v);
    };
    add(0, terms.energy);
    if constexpr (Kind::kHasCharges) add(kTallyOfCharges, terms.coulomb_energy);
    add(kTallyOfVirial, S::mul(x, fx));
    add(kTallyOfVirial + 1, S::mul(y, fy));
    add(kTallyOfVirial + 2, S::mul(z, fz));
    add(kTallyOfVirial + 3, S::mul(x, fy));
    add(kTallyOfVirial + 4, S::mul(x, fz));
    add(kTallyOfVirial + 5, S::mul(y, fz));
  } else {
    const auto add_product = [&](int n, V a, V b) { sum.number[n][0] = S::madd(a, b, sum.number[n][0]); };
    sum.number[0][0] = S::add(sum.number[0][0], terms.energy);
    if constexpr (Kind::kHasCharges)
      sum.number[kTallyOfCharges][0] = S::add(sum.number[kTallyOfCharges][0], terms.coulomb_energy);
    add_product(kTallyOfVirial, x, fx);
    add_product(kTallyOfVirial + 1, y, fy);
    add_product(kTallyOfVirial + 2, z, fz);
    add_product(kTallyOfVirial + 3, x, fy);
    add_product(kTallyOfVirial + 4, x, fz);
    add_product(kTallyOfVirial + 5, y, fz);
  }
}

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
template <class S, LjParameters kParameters, Wanted kFound, class Kind, Half kHalf, class J>
void apply(const LjTask<typename S::Real>& task, const J& beside, const Separations<S>& separation,
           PairCoefficients<S, kParameters>& coefficient, const RowCharges<S>& charges,
           const Constants<S>& constants, RowSums<S, kFound>& sum) {
  using V = typename S::V;
  coefficient.choose_j(beside);
  Coordinates<S> force;
  if constexpr (kHalf != Half::both)
    for (int p = 0; p < S::kRegisters; ++p) force.x[p] = force.y[p] = force.z[p] = S::zero();
  constexpr bool kSums = kFound != Wanted::forces;
  V of_j[kTallied];
  if constexpr (kFound == Wanted::tallies)
    for (V& v : of_j) v = S::zero();
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
    if constexpr (kSums) add_numbers<S, kFound, Kind>(terms, separation.d, force, p, constants, sum, of_j);
  }
  if constexpr (kFound == Wanted::tallies)
    for (int n = 0; n < kTallied; ++n)
      if (has_number<Kind>(n)) beside.tally(of_j[n], n, task.tallies);
  if constexpr (!kWantsLanes<S>) S::add_over_i(force, task.force[beside.cluster()]);
}

}  // namespace
}  // namespace dch::detail
