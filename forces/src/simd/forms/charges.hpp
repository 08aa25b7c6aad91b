// SPDX-License-Identifier: MIT
//
// How charges act beside a form; see style.hpp. What a weight takes from a pair whose charges act with the
// whole of space, or with its image at the cutoff, is a part of their bare term.
#pragma once

#include "simd/forms/lennard_jones.hpp"

namespace dch::detail {
namespace {

/// q_i q_j / r
struct BareCharges {
  static constexpr bool kAct = true;

  template <class S, bool kWeighted>
  static FormTerms<S> terms(const PairDistance<S>& at, typename S::V charge, const Constants<S>&,
                            typename S::V weight) {
    typename S::V bare = S::mul(charge, at.over_r);
    if constexpr (kWeighted) bare = S::mul(bare, weight);
    return {S::mul(bare, at.s), bare};
  }
};

/// Of charges whose bare energy is multiplied by factors. What a weight leaves out is left out of the bare
/// terms, since reciprocal space holds the whole.
template <class S, bool kWeighted>
FormTerms<S> screened_terms(const PairDistance<S>& at, typename S::V bare, EwaldFactors<S> factors,
                            typename S::V weight) {
  if constexpr (kWeighted) {
    const typename S::V left_out = S::sub(S::set1(1), weight);
    factors = {S::sub(factors.energy, left_out), S::sub(factors.force, left_out)};
  }
  return {S::mul(S::mul(bare, factors.force), at.s), S::mul(bare, factors.energy)};
}

/// q_i q_j erfc(splitting r) / r, by the formula of ewald_factors().
struct EwaldCharges {
  static constexpr bool kAct = true;

  template <class S, bool kWeighted>
  static FormTerms<S> terms(const PairDistance<S>& at, typename S::V charge, const Constants<S>& constants,
                            typename S::V weight) {
    using V = typename S::V;
    const V bare = S::mul(charge, at.over_r);
    const EwaldFactors<S> factors = ewald_factors<S>(S::mul(constants.splitting, at.r));
    return screened_terms<S, kWeighted>(at, bare, factors, weight);
  }
};

/// q_i q_j (erfc(splitting r) / r - energy - force r), whose energy and force are 0 at the cutoff; `force`
/// and `energy` are the first two numbers of charges (Fennell and Gezelter, J. Chem. Phys. 124:234104, 2006).
struct DampedShiftedCharges {
  static constexpr bool kAct = true;

  template <class S, bool kWeighted>
  static FormTerms<S> terms(const PairDistance<S>& at, typename S::V charge, const Constants<S>& constants,
                            typename S::V weight) {
    using V = typename S::V;
    const V bare = S::mul(charge, at.over_r);
    const V force = constants.of_charges[0], energy = constants.of_charges[1];
    EwaldFactors<S> factors = ewald_factors<S>(S::mul(constants.splitting, at.r), 1.12837916709551257);
    factors = {S::sub(factors.energy, S::madd(at.r2, force, S::mul(at.r, energy))),
               S::madd(at.r2, force, factors.force)};
    return screened_terms<S, kWeighted>(at, bare, factors, weight);
  }
};

/// q_i q_j / r, switched off by the factor of CharmmForm; the three numbers are those of charges. As in
/// LAMMPS the factor multiplies the force too, which so is not the slope of the energy.
struct SwitchedCharges {
  static constexpr bool kAct = true;

  template <class S, bool kWeighted>
  static FormTerms<S> terms(const PairDistance<S>& at, typename S::V charge, const Constants<S>& constants,
                            typename S::V weight) {
    const FormTerms<S> bare = BareCharges::terms<S, kWeighted>(at, charge, constants, weight);
    const typename S::V value = CharmmForm::factor<S>(at, constants.of_charges);
    return {S::mul(value, bare.force), S::mul(value, bare.energy)};
  }
};

}  // namespace
}  // namespace dch::detail
