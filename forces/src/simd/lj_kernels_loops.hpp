// SPDX-License-Identifier: MIT
//
// The loops of Lennard-Jones and Coulomb forces over vector types; see cluster_loops.hpp.
#pragma once

#include "simd/lj_terms_loops.hpp"

/// Forces inlining: a call inside of a loop would spill every register, and compilers make calls of functions
/// that have two callers. Sanitizers and the portable set, with arrays for registers, do without: inlining
/// would take them minutes to compile.
#if (defined(__SSE4_2__) || defined(DCH_NEON_SET)) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define DCH_FLATTEN [[gnu::flatten]]
#else
#define DCH_FLATTEN
#endif

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

template <class S, LjParameters kParameters, ForceKind kKind, class J>
Separations<S> measure(const LjTask<typename S::Real>& task, const ClusterPairs::Row& row, const Places<S>& i,
                       const J& beside, PairCoefficients<S, kParameters>& coefficient,
                       const Constants<S>& constants) {
  using V = typename S::V;
  const auto j = beside.places(task, row);
  coefficient.choose_j(beside);
  Separations<S> found;
  for (int p = 0; p < S::kRegisters; ++p) {
    const V dx = S::difference(j.x, i.x[p]), dy = S::difference(j.y, i.y[p]), dz = S::difference(j.z, i.z[p]);
    const V r2 = in_length2<S>(S::madd(dx, dx, S::madd(dy, dy, S::mul(dz, dz))), constants.unit2);
    found.d.x[p] = dx;
    found.d.y[p] = dy;
    found.d.z[p] = dz;
    found.r2[p] = r2;
    V reach2;
    if constexpr (has_one_cutoff(kKind))
      reach2 = coefficient.common_cutoff2();
    else
      reach2 = coefficient(kCutoff2, p);
    if constexpr (has_two_cutoffs(kKind)) reach2 = S::max(reach2, coefficient(kCoulombCutoff2, p));
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

/// Sums up the lanes of clusters and leaves them 0.
template <class S>
void fold_lanes(const LjTask<typename S::Real>& task, ClusterPairs::Range clusters) {
  for (std::int32_t c = clusters.first; c < clusters.last; ++c) {
    auto* const lanes = task.lanes + kNumbersOfLanes * c;
    Coordinates<S> force;
    force.x[0] = S::load(lanes);
    force.y[0] = S::load(lanes + 16);
    force.z[0] = S::load(lanes + 32);
    S::add_over_i(force, task.force[c]);
    for (int axis = 0; axis < 3; ++axis) S::store(lanes + 16 * axis, S::zero());
  }
}

/// Whether two entries at a time fit into registers. Four of each do not: spilling costs more than waiting
/// does.
template <class S>
constexpr bool kMeasuresAhead = S::kRegisters <= 2;

/// Adds the forces of an entry to those of its cluster J, and to what the row has summed up.
template <class S, LjParameters kParameters, bool kSums, ForceKind kKind, class J>
void apply(const LjTask<typename S::Real>& task, const J& beside, const Separations<S>& separation,
           PairCoefficients<S, kParameters>& coefficient, const RowCharges<S>& charges,
           const Constants<S>& constants, RowSums<S>& sum) {
  using V = typename S::V;
  coefficient.choose_j(beside);
  Coordinates<S> force;
  for (int p = 0; p < S::kRegisters; ++p) {
    const V dx = separation.d.x[p], dy = separation.d.y[p], dz = separation.d.z[p], s = separation.s[p];
    Products<S> products{S::zero(), S::zero()};
    if constexpr (has_charges(kKind)) products.charge = S::mul(charges.of_i[p], beside.repeat(task.charge));
    if constexpr (has_dispersion(kKind))
      products.dispersion = S::mul(charges.dispersion_of_i[p], beside.repeat(task.dispersion));
    const PairTerms<S> terms =
        pair_terms<S, kSums, kKind>(coefficient, p, separation.r2[p], s, products, constants);
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
      if constexpr (has_charges(kKind)) sum.coulomb_energy = S::add(sum.coulomb_energy, terms.coulomb_energy);
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

/// The pairs of a row with entries [entry, end), one or more. Separations are measured one entry ahead, if
/// they take few registers: the chain of dependent operations through one entry is longer than what a
/// processor can look ahead over.
template <class S, LjParameters kParameters, bool kSums, ForceKind kKind>
void add_entries(const LjTask<typename S::Real>& task, const ClusterPairs::Row& row, const Places<S>& i,
                 const ClusterPairs::Entry* entry, const ClusterPairs::Entry* end,
                 PairCoefficients<S, kParameters>& coefficient, const RowCharges<S>& charges,
                 const Constants<S>& constants, RowSums<S>& sum) {
  const ClusterPairs::Entry* const last = end - 1;
  const auto measured = [&](const ClusterPairs::Entry* of) {
    return measure<S, kParameters, kKind>(task, row, i, OneBeside<S>{of}, coefficient, constants);
  };
  const auto apply_to = [&](const ClusterPairs::Entry* to, const Separations<S>& separation) {
    apply<S, kParameters, kSums, kKind>(task, OneBeside<S>{to}, separation, coefficient, charges, constants,
                                        sum);
  };
  Separations<S> separation = measured(entry);
  for (; entry != last; ++entry) {
    if constexpr (kMeasuresAhead<S>) {
      const Separations<S> next = measured(entry + 1);
      apply_to(entry, separation);
      separation = next;
    } else {
      apply_to(entry, separation);
      separation = measured(entry + 1);
    }
  }
  apply_to(entry, separation);
}

/// Those that are joined two by two.
template <class S, LjParameters kParameters, bool kSums, ForceKind kKind>
void add_joined(const LjTask<typename S::Real>& task, const ClusterPairs::Row& row, const Places<S>& i,
                const ClusterPairs::Entry* entry, const ClusterPairs::Entry* end,
                PairCoefficients<S, kParameters>& coefficient, const RowCharges<S>& charges,
                const Constants<S>& constants, RowSums<S>& sum) {
  const std::uint16_t* of_second = task.of_second + (entry - task.entries) / 2;
  for (; entry != end; entry += 2) {
    const TwoBeside<S> beside{entry, *of_second++};
    const Separations<S> separation =
        measure<S, kParameters, kKind>(task, row, i, beside, coefficient, constants);
    apply<S, kParameters, kSums, kKind>(task, beside, separation, coefficient, charges, constants, sum);
  }
}

template <class S, LjParameters kParameters, bool kSums, ForceKind kKind>
DCH_FLATTEN void lennard_jones(const LjTask<typename S::Real>& given, LjSums& sums) {
  const LjTask<typename S::Real> task = given;  // which no number that is written can be part of
  PairCoefficients<S, kParameters> coefficient(task);
  const Constants<S> constants(task.constants, task.unit);
  RowCharges<S> charges{};
  for (std::int64_t r = 0; r < task.row_count; ++r) {
    const ClusterPairs::Row row = task.rows[r];
    const Places<S> i = spread<S>(task.at[row.cluster]);
    coefficient.choose_i(row.cluster);
    if constexpr (has_charges(kKind))
      for (int p = 0; p < S::kRegisters; ++p) charges.of_i[p] = S::spread(task.charge + 4 * row.cluster, p);
    if constexpr (has_dispersion(kKind))
      for (int p = 0; p < S::kRegisters; ++p)
        charges.dispersion_of_i[p] = S::spread(task.dispersion + 4 * row.cluster, p);
    RowSums<S> sum;
    for (int p = 0; p < S::kRegisters; ++p) sum.force.x[p] = sum.force.y[p] = sum.force.z[p] = S::zero();
    sum.energy = sum.coulomb_energy = S::zero();
    for (auto& v : sum.virial) v = S::zero();
    const ClusterPairs::Entry* const entry = task.entries + row.first;
    const ClusterPairs::Entry* const end = task.entries + task.rows[r + 1].first;
    const ClusterPairs::Entry* joined = end;
    if constexpr (kWantsLanes<S>)
      if (task.alone != nullptr) joined = entry + task.alone[r];
    if (joined != entry)
      add_entries<S, kParameters, kSums, kKind>(task, row, i, entry, joined, coefficient, charges, constants,
                                                sum);
    if constexpr (kWantsLanes<S>)
      add_joined<S, kParameters, kSums, kKind>(task, row, i, joined, end, coefficient, charges, constants,
                                               sum);
    S::subtract_over_j(sum.force, task.force[row.cluster]);
    if constexpr (kSums) {
      sums.energy += S::sum(sum.energy);
      if constexpr (has_charges(kKind)) sums.coulomb_energy += S::sum(sum.coulomb_energy);
      for (int k = 0; k < 6; ++k) sums.virial[k] += task.unit * S::sum(sum.virial[k]);
    }
  }
  if constexpr (kWantsLanes<S>) {
    fold_lanes<S>(task, task.own);
    for (const ClusterPairs::Range& range : task.later) fold_lanes<S>(task, range);
  }
}

template <class S, ForceKind kKind>
constexpr typename LjFunctions<LjTask<typename S::Real>>::OfKind lj_functions_of_kind{
    {{lennard_jones<S, LjParameters::one_type, false, kKind>,
      lennard_jones<S, LjParameters::one_type, true, kKind>},
     {lennard_jones<S, LjParameters::by_type, false, kKind>,
      lennard_jones<S, LjParameters::by_type, true, kKind>},
     {nullptr, nullptr}}};

/// With parameters by particle too.
template <class S, ForceKind kKind>
constexpr typename LjFunctions<LjTask<typename S::Real>>::OfKind lj_functions_that_mix{
    {{lennard_jones<S, LjParameters::one_type, false, kKind>,
      lennard_jones<S, LjParameters::one_type, true, kKind>},
     {lennard_jones<S, LjParameters::by_type, false, kKind>,
      lennard_jones<S, LjParameters::by_type, true, kKind>},
     {lennard_jones<S, LjParameters::by_particle, false, kKind>,
      lennard_jones<S, LjParameters::by_particle, true, kKind>}}};

template <class S>
constexpr LjFunctions<LjTask<typename S::Real>> lj_functions_of{
    {lj_functions_that_mix<S, ForceKind::lennard_jones>, lj_functions_of_kind<S, ForceKind::plain>,
     lj_functions_of_kind<S, ForceKind::ewald>, lj_functions_that_mix<S, ForceKind::reaction_field>,
     lj_functions_that_mix<S, ForceKind::switched>,
     lj_functions_that_mix<S, ForceKind::switched_reaction_field>,
     lj_functions_that_mix<S, ForceKind::ewald_series>, lj_functions_that_mix<S, ForceKind::switched_ewald>,
     lj_functions_that_mix<S, ForceKind::ewald_dispersion>},
    kWantsLanes<S>};

}  // namespace
}  // namespace dch::detail
