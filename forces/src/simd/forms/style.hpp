// SPDX-License-Identifier: MIT
//
// What makes a kind of force, for the loops over pairs, of a form and of how charges act; see
// cluster_loops.hpp. A form is a struct like Morse beside this file: it says how the numbers that it is given
// become those that stand in tables, and what a pair adds. Tables, cutoffs, shifts of energy, weights, sums
// and the loops are here and in lj_kernels_loops.hpp.
#pragma once

#include "simd/lj_pair_kernels_loops.hpp"

namespace dch::detail {
namespace {

/// Of pairs that act; of others s, 1/r and r are 0.
template <class S>
struct PairDistance {
  using V = typename S::V;
  using Lanes = decltype(S::less(S::zero(), S::zero(), 0, 0));
  PairDistance(V squared, V inverse)
      : r2(squared),
        s(inverse),
        over_r(S::over_root(squared, inverse)),
        r(S::mul(squared, over_r)),
        acts(S::less(S::zero(), inverse, 0xFFFF, 0)) {}
  V r2, s, over_r, r;  ///< r^2, 1/r^2, 1/r, r
  Lanes acts;
};

/// What pairs add by a form or by charges, the force divided by r. Where nothing acts forces are 0 and
/// energies any number.
template <class S>
struct FormTerms {
  typename S::V force, energy;
};

/// Number n, from 0, that a form has for each pair of types, as a register of pairs needs it.
template <class S, class Coefficients>
typename S::V form_number(const Coefficients& coefficient, int n, int p) {
  return coefficient(kForce12 + n, p);
}

struct NoCharges {
  static constexpr bool kAct = false;
};

/// Forces and energies of a form and of charges, each within its cutoff.
template <class Form, class Charges>
struct Style {
  static constexpr bool kHasCharges = Charges::kAct, kHasDispersion = false;
  static constexpr bool kHasOneCutoff = false, kHasTwoCutoffs = Charges::kAct;
  static constexpr bool kActsAtZero = Form::kActsAtZero;

  template <class S, bool kSums, class Coefficients>
  static PairTerms<S> terms(const Coefficients& coefficient, int p, typename S::V r2, typename S::V s,
                            const Products<S>& products, const Constants<S>& constants) {
    return all_terms<S, kSums, false>(coefficient, p, PairDistance<S>(r2, s), products, constants,
                                      PairWeights<S>{S::zero(), S::zero()});
  }
  template <class S, bool kSums, class Coefficients>
  static PairTerms<S> weighted_terms(const Coefficients& coefficient, int p, typename S::V r2,
                                     typename S::V s, const Products<S>& products,
                                     const Constants<S>& constants, const PairWeights<S>& weights) {
    return all_terms<S, kSums, true>(coefficient, p, PairDistance<S>(r2, s), products, constants, weights);
  }

 private:
  template <class S, bool kSums, bool kWeighted, class Coefficients>
  static PairTerms<S> all_terms(const Coefficients& coefficient, int p, const PairDistance<S>& at,
                                const Products<S>& products, const Constants<S>& constants,
                                const PairWeights<S>& weights) {
    FormTerms<S> own = Form::template terms<S>(coefficient, p, at, constants);
    if constexpr (kSums && Form::kMayBeShifted && !Coefficients::kMixes)
      own.energy = S::sub(own.energy, coefficient(kEnergyShift, p));
    if constexpr (kWeighted) own = {S::mul(weights.own, own.force), S::mul(weights.own, own.energy)};
    PairTerms<S> sum{own.force, S::zero(), S::zero()};
    if constexpr (kSums) sum.energy = S::keep(at.acts, own.energy);
    if constexpr (Charges::kAct) {
      const auto is_near = S::less(at.r2, coefficient(kCutoff2, p), 0xFFFF, 0);
      const auto charges_are_near = S::less(at.r2, coefficient(kCoulombCutoff2, p), 0xFFFF, 0);
      const FormTerms<S> more =
          Charges::template terms<S, kWeighted>(at, products.charge, constants, weights.charges);
      sum.force = S::add(S::keep(is_near, own.force), S::keep(charges_are_near, more.force));
      if constexpr (kSums) {
        sum.energy = S::keep(is_near, sum.energy);
        sum.coulomb_energy = S::keep(charges_are_near, S::keep(at.acts, more.energy));
      }
    }
    return sum;
  }
};

}  // namespace
}  // namespace dch::detail
