// SPDX-License-Identifier: MIT
//
// All forms with all charges that they go with; see cluster_loops.hpp.
#pragma once

#include "simd/form_kernels.hpp"
#include "simd/forms/charges.hpp"
#include "simd/forms/colloid.hpp"
#include "simd/forms/exponentials.hpp"
#include "simd/forms/soft.hpp"
#include "simd/forms/table.hpp"
#include "simd/row_kernels_loops.hpp"

namespace dch::detail {
namespace {

template <class S, class Kind>
void batch_of_pairs(const BatchTask& task, PairBatch& pairs) {
  using V = typename S::V;
  LaneCoefficients<S, LjParameters::by_type> coefficient(task.coefficients);
  const Constants<S> constants(task.constants);
  for (int k = 0; k < PairBatch::kSize; k += S::kLanes) {
    const LanePairs lanes{nullptr, nullptr, nullptr, pairs.types + k, pairs.kind + k};
    coefficient.choose({}, lanes);
    V r2 = S::load(pairs.r2 + k);
    if constexpr (Kind::kActsAtZero) r2 = S::max(r2, S::set1(kNearZero<double>));
    const V reach2 = S::max(coefficient(kCutoff2, 0), coefficient(kCoulombCutoff2, 0));
    const V s = S::keep(S::less(r2, reach2, 0xFFFF, 0), S::inverse(r2));
    const V charge = S::mul(S::set1(task.constant), S::load(pairs.charges + k));
    const PairTerms<S> found = Kind::template weighted_terms<S, true>(
        coefficient, 0, r2, s, {charge, S::zero()}, constants,
        {S::gather(task.weight, lanes.kind), S::gather(task.charge_weight, lanes.kind)});
    S::store(pairs.force_over_r + k, found.force);
    S::store(pairs.energy + k, found.energy);
    S::store(pairs.coulomb_energy + k, found.coulomb_energy);
  }
}

/// Loops by table, of one type too or mixed by particle where these are asked for; tallies not of the latter,
/// for whose types there are tables too.
template <class S, class Kind, bool kOneType, bool kMixes>
constexpr typename LjFunctions<LjTask<typename S::Real>>::OfKind cluster_functions() {
  typename LjFunctions<LjTask<typename S::Real>>::OfKind all{
      {{},
       {lennard_jones<S, LjParameters::by_type, Wanted::forces, Kind>,
        lennard_jones<S, LjParameters::by_type, Wanted::sums, Kind>,
        lennard_jones<S, LjParameters::by_type, Wanted::tallies, Kind>},
       {}}};
  if constexpr (kOneType) {
    all.of_parameters[0][0] = lennard_jones<S, LjParameters::one_type, Wanted::forces, Kind>;
    all.of_parameters[0][1] = lennard_jones<S, LjParameters::one_type, Wanted::sums, Kind>;
    all.of_parameters[0][2] = lennard_jones<S, LjParameters::one_type, Wanted::tallies, Kind>;
  }
  if constexpr (kMixes) {
    all.of_parameters[2][0] = lennard_jones<S, LjParameters::by_particle, Wanted::forces, Kind>;
    all.of_parameters[2][1] = lennard_jones<S, LjParameters::by_particle, Wanted::sums, Kind>;
  }
  return all;
}

template <class S, class Kind, bool kOneType>
constexpr LjFunctions<LjPairTask>::OfKind pair_functions() {
  constexpr auto kByType = LjParameters::by_type, kOne = LjParameters::one_type;
  LjFunctions<LjPairTask>::OfKind all{{{},
                                       {lennard_jones_of_pairs<S, kByType, Wanted::forces, Kind>,
                                        lennard_jones_of_pairs<S, kByType, Wanted::sums, Kind>,
                                        lennard_jones_of_pairs<S, kByType, Wanted::tallies, Kind>},
                                       {}}};
  if constexpr (kOneType) {
    all.of_parameters[0][0] = lennard_jones_of_pairs<S, kOne, Wanted::forces, Kind>;
    all.of_parameters[0][1] = lennard_jones_of_pairs<S, kOne, Wanted::sums, Kind>;
    all.of_parameters[0][2] = lennard_jones_of_pairs<S, kOne, Wanted::tallies, Kind>;
  }
  return all;
}

/// For particles with many neighbors.
template <class S, class Kind>
constexpr LjFunctions<LjPairTask>::OfKind row_functions() {
  return {{{},
           {rows_of_pairs<S, Wanted::forces, Kind>, rows_of_pairs<S, Wanted::sums, Kind>,
            rows_of_pairs<S, Wanted::tallies, Kind>},
           {}}};
}

template <class Single, class Double, class Form, class Charges, bool kOneType = false, bool kMixes = false,
          bool kByRows = false>
constexpr FormKernels::OfStyle style_kernels() {
  using Kind = Style<Form, Charges>;
  constexpr auto kByType = LjParameters::by_type;
  auto functions_of_pairs = pair_functions<Double, Kind, kOneType>();
  if constexpr (kByRows) functions_of_pairs = row_functions<Double, Kind>();
  return {cluster_functions<Single, Kind, kOneType, kMixes>(),
          cluster_functions<Double, Kind, kOneType, kMixes>(),
          functions_of_pairs,
          {lennard_jones_of_pairs<Double, kByType, Wanted::forces, Kind, true>,
           lennard_jones_of_pairs<Double, kByType, Wanted::sums, Kind, true>,
           lennard_jones_of_pairs<Double, kByType, Wanted::tallies, Kind, true>},
          batch_of_pairs<Double, Kind>,
          Form::prepare,
          Form::kGiven,
          Form::kMayBeShifted};
}

/// In the order of PairForm and ChargeForm.
template <class F, class D>
constexpr FormKernels form_kernels_of{
    {{style_kernels<F, D, LennardJonesForm, NoCharges, true>(),
      style_kernels<F, D, LennardJonesForm, BareCharges>(),
      style_kernels<F, D, LennardJonesForm, EwaldCharges>(),
      style_kernels<F, D, LennardJonesForm, DampedShiftedCharges>(),
      {}},
     {{},
      {},
      style_kernels<F, D, CharmmForm, EwaldCharges, false, true>(),
      {},
      style_kernels<F, D, CharmmForm, SwitchedCharges, false, true>()},
     {{}, {}, style_kernels<F, D, CharmmForceForm, EwaldCharges, false, true>(), {}, {}},
     {style_kernels<F, D, ExpandedForm, NoCharges>(), {}, {}, {}, {}},
     {style_kernels<F, D, BuckinghamForm, NoCharges>(),
      {},
      style_kernels<F, D, BuckinghamForm, EwaldCharges>(),
      {},
      {}},
     {style_kernels<F, D, MorseForm, NoCharges>(), {}, {}, {}, {}},
     {style_kernels<F, D, SoftForm, NoCharges>(), {}, {}, {}, {}},
     {style_kernels<F, D, YukawaForm, NoCharges>(), {}, {}, {}, {}},
     {style_kernels<F, D, TableForm, NoCharges, true>(), {}, {}, {}, {}},
     {style_kernels<F, D, SplineForm, NoCharges, true>(), {}, {}, {}, {}},
     {style_kernels<F, D, ColloidForm, NoCharges, false, false, true>(), {}, {}, {}, {}}},
    kWantsLanes<F>,
    kWantsLanes<D>};

}  // namespace
}  // namespace dch::detail
