// SPDX-License-Identifier: MIT
//
// The loops of Lennard-Jones and Coulomb forces over vector types; see cluster_loops.hpp.
#pragma once

#include "simd/lj_entry_loops.hpp"

/// Forces inlining: a call inside of a loop would spill every register, and compilers make calls of functions
/// that have two callers. Sanitizers do without, and so do SSE4.2, which few processors are left with, and
/// the portable set: inlining would take them minutes to compile.
#if (defined(__AVX2__) || defined(DCH_NEON_SET)) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define DCH_FLATTEN [[gnu::flatten]]
#else
#define DCH_FLATTEN
#endif

namespace dch::detail {
namespace {

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

/// Whether registers without pairs are left out. With eight or more registers an entry, or with sums, which
/// few steps ask for, two more loops would only take long to compile.
template <class S, Wanted kFound>
constexpr bool kLeavesOutHalves = S::kRegisters > 1 && S::kRegisters <= 4 && kFound == Wanted::forces;

/// Whether two entries at a time fit into registers. Four of each do not: spilling costs more than waiting
/// does.
template <class S>
constexpr bool kMeasuresAhead = S::kRegisters <= 2;

/// The pairs of a row with entries [entry, end). Separations are measured one entry ahead, if they take few
/// registers: the chain of dependent operations through one entry is longer than what a processor can look
/// ahead over.
template <class S, LjParameters kParameters, Wanted kFound, class Kind, Half kHalf, class J>
void add_entries(const LjTask<typename S::Real>& task, const ClusterPairs::Row& row, const Places<S>& i,
                 const ClusterPairs::Entry* entry, const ClusterPairs::Entry* end,
                 PairCoefficients<S, kParameters>& coefficient, const RowCharges<S>& charges,
                 const Constants<S>& constants, RowSums<S, kFound>& sum) {
  if (entry == end) return;
  const ClusterPairs::Entry* const last = end - 1;
  const auto measured = [&](const ClusterPairs::Entry* of) {
    return measure<S, kParameters, Kind, kHalf>(task, row, i, J{of}, coefficient, constants);
  };
  const auto apply_to = [&](const ClusterPairs::Entry* to, const Separations<S>& separation) {
    apply<S, kParameters, kFound, Kind, kHalf>(task, J{to}, separation, coefficient, charges, constants, sum);
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
template <class S, LjParameters kParameters, Wanted kFound, class Kind>
void add_joined(const LjTask<typename S::Real>& task, const ClusterPairs::Row& row, const Places<S>& i,
                const ClusterPairs::Entry* entry, const ClusterPairs::Entry* end,
                PairCoefficients<S, kParameters>& coefficient, const RowCharges<S>& charges,
                const Constants<S>& constants, RowSums<S, kFound>& sum) {
  for (; entry != end; entry += 2) {
    const TwoBeside<S> beside{entry};
    const Separations<S> separation =
        measure<S, kParameters, Kind, Half::both>(task, row, i, beside, coefficient, constants);
    apply<S, kParameters, kFound, Kind, Half::both>(task, beside, separation, coefficient, charges, constants,
                                                    sum);
  }
}

/// All entries of a row, in whatever order they stand. Those that are joined can be taken one by one, too.
template <class S, LjParameters kParameters, Wanted kFound, class Kind>
void add_row(const LjTask<typename S::Real>& task, std::int64_t r, Places<S>& i,
             PairCoefficients<S, kParameters>& coefficient, const RowCharges<S>& charges,
             const Constants<S>& constants, RowSums<S, kFound>& sum) {
  const ClusterPairs::Row row = task.rows[r];
  const ClusterPairs::Entry* const entry = task.entries + row.first;
  const ClusterPairs::Entry* const end = task.entries + task.rows[r + 1].first;
  using Order = ClusterPairs::EntryOrder;
  using Unmoved = OneBeside<S, false>;
  if constexpr (kWantsLanes<S>) {
    if (task.order == Order::joined) {
      subtract_shift<S>(task.shift[row.first_shift + entry->shift], i);
      const ClusterPairs::Entry* const joined = entry + task.parts[r].first;
      add_entries<S, kParameters, kFound, Kind, Half::both, Unmoved>(task, row, i, entry, joined, coefficient,
                                                                     charges, constants, sum);
      add_joined<S, kParameters, kFound, Kind>(task, row, i, joined, end, coefficient, charges, constants,
                                               sum);
      return;
    }
  }
  const ClusterPairs::Entry *lower = end, *upper = end;
  if constexpr (kLeavesOutHalves<S, kFound>)
    if (task.order == Order::by_image_and_halves || (!kShiftsByImage<S> && task.order == Order::by_halves))
      lower = entry + task.parts[r].first, upper = entry + task.parts[r].lower;
  if constexpr (kLeavesOutHalves<S, kFound> && kShiftsByImage<S>) {
    if (task.order == Order::by_image_and_halves) {
      subtract_shift<S>(task.shift[row.first_shift + entry->shift], i);
      add_entries<S, kParameters, kFound, Kind, Half::both, Unmoved>(task, row, i, entry, lower, coefficient,
                                                                     charges, constants, sum);
      add_entries<S, kParameters, kFound, Kind, Half::lower, Unmoved>(task, row, i, lower, upper, coefficient,
                                                                      charges, constants, sum);
      add_entries<S, kParameters, kFound, Kind, Half::upper, Unmoved>(task, row, i, upper, end, coefficient,
                                                                      charges, constants, sum);
      return;
    }
  }
  add_entries<S, kParameters, kFound, Kind, Half::both, OneBeside<S>>(task, row, i, entry, lower, coefficient,
                                                                      charges, constants, sum);
  if constexpr (kLeavesOutHalves<S, kFound> && !kShiftsByImage<S>) {
    add_entries<S, kParameters, kFound, Kind, Half::lower, OneBeside<S>>(
        task, row, i, lower, upper, coefficient, charges, constants, sum);
    add_entries<S, kParameters, kFound, Kind, Half::upper, OneBeside<S>>(
        task, row, i, upper, end, coefficient, charges, constants, sum);
  }
}

template <class S, LjParameters kParameters, Wanted kFound, class Kind>
DCH_FLATTEN void lennard_jones(const LjTask<typename S::Real>& given, LjSums& sums) {
  const LjTask<typename S::Real> task = given;  // which no number that is written can be part of
  PairCoefficients<S, kParameters> coefficient(task);
  const Constants<S> constants(task.constants, task.unit);
  RowCharges<S> charges{};
  for (std::int64_t r = 0; r < task.row_count; ++r) {
    const ClusterPairs::Row row = task.rows[r];
    Places<S> i = spread<S>(task.at[row.cluster]);
    coefficient.choose_i(row.cluster);
    if constexpr (Kind::kHasCharges)
      for (int p = 0; p < S::kRegisters; ++p) charges.of_i[p] = S::spread(task.charge + 4 * row.cluster, p);
    if constexpr (Kind::kHasDispersion)
      for (int p = 0; p < S::kRegisters; ++p)
        charges.dispersion_of_i[p] = S::spread(task.dispersion + 4 * row.cluster, p);
    RowSums<S, kFound> sum;
    sum.clear();
    add_row<S, kParameters, kFound, Kind>(task, r, i, coefficient, charges, constants, sum);
    S::subtract_over_j(sum.force, task.force[row.cluster]);
    sum.template give<Kind>(task, row.cluster, sums);
  }
  if constexpr (kWantsLanes<S>) {
    fold_lanes<S>(task, task.own);
    for (const ClusterPairs::Range& range : task.later) fold_lanes<S>(task, range);
  }
}

template <class S, class Kind>
constexpr typename LjFunctions<LjTask<typename S::Real>>::OfKind lj_functions_of_kind{
    {{lennard_jones<S, LjParameters::one_type, Wanted::forces, Kind>,
      lennard_jones<S, LjParameters::one_type, Wanted::sums, Kind>},
     {lennard_jones<S, LjParameters::by_type, Wanted::forces, Kind>,
      lennard_jones<S, LjParameters::by_type, Wanted::sums, Kind>},
     {}}};

/// With parameters by particle too.
template <class S, class Kind>
constexpr typename LjFunctions<LjTask<typename S::Real>>::OfKind lj_functions_that_mix{
    {{lennard_jones<S, LjParameters::one_type, Wanted::forces, Kind>,
      lennard_jones<S, LjParameters::one_type, Wanted::sums, Kind>},
     {lennard_jones<S, LjParameters::by_type, Wanted::forces, Kind>,
      lennard_jones<S, LjParameters::by_type, Wanted::sums, Kind>},
     {lennard_jones<S, LjParameters::by_particle, Wanted::forces, Kind>,
      lennard_jones<S, LjParameters::by_particle, Wanted::sums, Kind>}}};

template <class S>
constexpr LjFunctions<LjTask<typename S::Real>> lj_functions_of{
    {lj_functions_that_mix<S, LjKind<ForceKind::lennard_jones>>,
     lj_functions_of_kind<S, LjKind<ForceKind::plain>>, lj_functions_of_kind<S, LjKind<ForceKind::ewald>>,
     lj_functions_that_mix<S, LjKind<ForceKind::reaction_field>>,
     lj_functions_that_mix<S, LjKind<ForceKind::switched>>,
     lj_functions_that_mix<S, LjKind<ForceKind::switched_reaction_field>>,
     lj_functions_that_mix<S, LjKind<ForceKind::ewald_series>>,
     lj_functions_that_mix<S, LjKind<ForceKind::switched_ewald>>,
     lj_functions_that_mix<S, LjKind<ForceKind::ewald_dispersion>>},
    kWantsLanes<S>,
    kLeavesOutHalves<S, Wanted::forces>};

}  // namespace
}  // namespace dch::detail
