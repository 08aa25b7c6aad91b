// SPDX-License-Identifier: MIT
//
// What a pair adds to Lennard-Jones and Coulomb forces, over vector types; see cluster_loops.hpp.
#pragma once

#include "simd/lj_coefficients_loops.hpp"

namespace dch::detail {
namespace {

/// e^y for y <= 80 (700 in double precision), to a unit in the last place or two where y <= 0; not less than
/// the least normal number.
template <class S>
typename S::V exponential(typename S::V y) {
  using V = typename S::V;
  using Real = typename S::Real;
  constexpr bool kSingle = sizeof(Real) == 4;
  // Added to a small integer, this leaves it in the last bits.
  constexpr Real kInteger = kSingle ? Real(0x1.8p23) : Real(0x1.8p52);
  constexpr Real kLog2OfE = Real(1.4426950408889634);
  // ln 2 in two parts, the first so short that integers times it are exact.
  constexpr Real kLn2High = kSingle ? Real(0x1.62ep-1) : Real(0x1.62e42feep-1);
  constexpr Real kLn2Low = kSingle ? Real(0x1.0bfbe8p-15) : Real(0x1.a39ef35793c76p-33);
  constexpr Real kMin = kSingle ? Real(-87) : Real(-708);
  // 1/k!, highest first: the remainder is below 0.35^8/8! (single) or 0.35^14/14! (double).
  constexpr double kSeries[] = {
      1.0 / 6227020800, 1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880, 1.0 / 40320, 1.0 / 5040,
      1.0 / 720,        1.0 / 120,       1.0 / 24,       1.0 / 6,       0.5,          1.0,         1.0};
  y = S::max(y, S::set1(kMin));
  const V shifted = S::madd(y, S::set1(kLog2OfE), S::set1(kInteger));
  const V n = S::sub(shifted, S::set1(kInteger));
  const V rest = S::madd(n, S::set1(-kLn2Low), S::madd(n, S::set1(-kLn2High), y));
  constexpr int kFirst = kSingle ? 6 : 0;
  V sum = S::set1(Real(kSeries[kFirst]));
  for (int k = kFirst + 1; k < 14; ++k) sum = S::madd(sum, rest, S::set1(Real(kSeries[k])));
  return S::mul(sum, S::power_of_two(n));
}

/// What an Ewald sum leaves to a pair, relative to the bare Coulomb term.
template <class S>
struct EwaldFactors {
  typename S::V energy, force;
};

/// erfc(x) and erfc(x) + 2 x e^(-x^2) / sqrt(pi), by formula 7.1.26 of Abramowitz and Stegun, Handbook of
/// Mathematical Functions (1964), which is within 1.5e-7. The digits are those of LAMMPS's pair styles, with
/// which the results have to agree; so are those of 2 / sqrt(pi), of which its styles have two.
template <class S>
EwaldFactors<S> ewald_factors(typename S::V x, double two_over_root_pi = 1.12837917) {
  using V = typename S::V;
  using Real = typename S::Real;
  const V expm2 = exponential<S>(S::mul(S::sub(S::zero(), x), x));
  const V t = S::inverse(S::madd(S::set1(Real(0.3275911)), x, S::set1(1)));
  V poly = S::madd(t, S::set1(Real(1.061405429)), S::set1(Real(-1.453152027)));
  poly = S::madd(t, poly, S::set1(Real(1.421413741)));
  poly = S::madd(t, poly, S::set1(Real(-0.284496736)));
  poly = S::madd(t, poly, S::set1(Real(0.254829592)));
  const V erfc = S::mul(S::mul(t, poly), expm2);
  return {erfc, S::madd(S::mul(S::set1(static_cast<Real>(two_over_root_pi)), x), expm2, erfc)};
}

/// LjConstants in all lanes.
template <class S>
struct Constants {
  explicit Constants(const LjConstants<typename S::Real>& c, double unit_of_length = 1)
      : unit(S::set1(static_cast<typename S::Real>(unit_of_length))),
        unit2(S::mul(unit, unit)),
        splitting(S::set1(c.splitting)),
        quadratic(S::set1(c.quadratic)),
        offset(S::set1(c.offset)),
        switch_from(S::set1(c.switch_from)),
        over_width(S::set1(c.over_width)),
        series_scale(S::set1(c.series_scale)),
        over_cutoff2(S::set1(c.over_cutoff2)),
        series(&c) {
    for (int k = 0; k < kNumbersOfForm; ++k) of_form[k] = S::set1(c.of_form[k]);
    for (int k = 0; k < kNumbersOfCharges; ++k) of_charges[k] = S::set1(c.of_charges[k]);
  }
  typename S::V unit, unit2, splitting, quadratic, offset, switch_from, over_width, series_scale,
      over_cutoff2, of_form[kNumbersOfForm], of_charges[kNumbersOfCharges];
  const LjConstants<typename S::Real>* series;
};

/// What the pairs of a register add: force / r, energies.
template <class S>
struct PairTerms {
  typename S::V force, energy, coulomb_energy;
};

/// Of Lennard-Jones alone. The energy is not shifted, and not computed unless it is wanted.
template <class S, bool kEnergy, class Coefficients>
PairTerms<S> lennard_jones_terms(const Coefficients& coefficient, int p, typename S::V s) {
  using V = typename S::V;
  using Real = typename S::Real;
  PairTerms<S> terms{S::zero(), S::zero(), S::zero()};
  if constexpr (Coefficients::kMixes) {
    const V sigma = coefficient.sigma(p), s2 = S::mul(S::mul(sigma, sigma), s);
    const V s6 = S::mul(S::mul(s2, s2), s2), attraction = S::mul(coefficient.four_epsilon(p), s6);
    const V inner = S::msub(S::set1(Real(12)), s6, S::set1(Real(6)));
    terms.force = S::mul(S::mul(attraction, inner), s);
    if constexpr (kEnergy) terms.energy = S::msub(attraction, s6, attraction);
  } else {
    const V s3 = S::mul(S::mul(s, s), s);
    terms.force = S::mul(S::mul(s3, s), S::msub(coefficient(kForce12, p), s3, coefficient(kForce6, p)));
    if constexpr (kEnergy)
      terms.energy = S::mul(s3, S::msub(coefficient(kEnergy12, p), s3, coefficient(kEnergy6, p)));
  }
  return terms;
}

/// Multiplies the energy by 1 + t^3 (-10 + t (15 - 6 t)), t = max(0, (r - from) / width); nothing acts beyond
/// t = 1.
template <class S>
void switch_off(typename S::V r, typename S::V over_r, const Constants<S>& constants, PairTerms<S>& terms) {
  using V = typename S::V;
  using Real = typename S::Real;
  const V t = S::max(S::zero(), S::mul(S::sub(r, constants.switch_from), constants.over_width));
  const V t2 = S::mul(t, t);
  const V tail = S::madd(t, S::madd(t, S::set1(Real(-6)), S::set1(Real(15))), S::set1(Real(-10)));
  const V value = S::madd(S::mul(t2, t), tail, S::set1(Real(1)));
  const V bend = S::madd(t, S::madd(t, S::set1(Real(-30)), S::set1(Real(60))), S::set1(Real(-30)));
  const V slope = S::mul(S::mul(t2, bend), constants.over_width);
  terms.force = S::msub(value, terms.force, S::mul(S::mul(slope, terms.energy), over_r));
  terms.energy = S::mul(value, terms.energy);
}

/// Charges in a reaction field, which ends where Lennard-Jones does.
template <class S, bool kSums>
void add_reaction_field(typename S::V r2, typename S::V s, typename S::V over_r, typename S::V charge,
                        const Constants<S>& constants, PairTerms<S>& terms) {
  using V = typename S::V;
  const V field = S::mul(constants.quadratic, r2);
  terms.force = S::madd(S::mul(charge, s), S::sub(over_r, S::add(field, field)), terms.force);
  if constexpr (kSums) {
    const V energy = S::mul(charge, S::add(over_r, S::sub(field, constants.offset)));
    terms.coulomb_energy = S::keep(S::less(S::zero(), s, 0xFFFF, 0), energy);
  }
}

/// A series in powers of u, the even ones and the odd ones side by side.
template <class S>
typename S::V series(const typename S::Real* term, typename S::V u) {
  using V = typename S::V;
  constexpr int kTerms = kEwaldTerms<typename S::Real>;
  static_assert(kTerms % 2 == 0);
  const V u2 = S::mul(u, u);
  V even = S::set1(term[kTerms - 2]), odd = S::set1(term[kTerms - 1]);
  for (int k = kTerms - 4; k >= 0; k -= 2) {
    even = S::madd(even, u2, S::set1(term[k]));
    odd = S::madd(odd, u2, S::set1(term[k + 1]));
  }
  return S::madd(odd, u, even);
}

/// What an Ewald sum leaves to charges: their bare term less what reciprocal space holds of them, which does
/// not end where they are too far apart.
template <class S, bool kSums>
void add_ewald(typename S::V r2, typename S::V s, typename S::V over_r, typename S::V charge,
               const Constants<S>& constants, PairTerms<S>& terms) {
  using V = typename S::V;
  const auto acts = S::less(S::zero(), s, 0xFFFF, 0);
  const V u = S::msub(r2, constants.series_scale, S::set1(1));
  const V far = S::keep(acts, series<S>(constants.series->ewald_force, u));
  terms.force = S::madd(charge, S::msub(over_r, s, far), terms.force);
  if constexpr (kSums) {
    const V far_energy = S::keep(acts, series<S>(constants.series->ewald_energy, u));
    terms.coulomb_energy = S::mul(charge, S::sub(over_r, far_energy));
  }
}

/// Takes away what reciprocal space holds of the dispersion of a pair, which attracts. All of the pair's
/// energy but that of charges is lowered by its value at the cutoff; Lennard-Jones's by a table is so
/// already.
template <class S, bool kSums, class Coefficients>
void add_dispersion(const Coefficients& coefficient, int p, typename S::V r2, typename S::V s,
                    typename S::V product, const Constants<S>& constants, PairTerms<S>& terms) {
  using V = typename S::V;
  const auto acts = S::less(S::zero(), s, 0xFFFF, 0);
  const V u = S::msub(r2, constants.series_scale, S::set1(1));
  const V far = S::keep(acts, series<S>(constants.series->dispersion_force, u));
  terms.force = S::madd(product, far, terms.force);
  if constexpr (kSums) {
    V energy = S::mul(product, series<S>(constants.series->dispersion_energy, u));
    if constexpr (Coefficients::kMixes)
      energy = S::sub(energy, lennard_jones_terms<S, true>(coefficient, p, constants.over_cutoff2).energy);
    terms.energy = S::add(terms.energy, S::keep(acts, energy));
  }
}

/// Products of two particles' numbers.
template <class S>
struct Products {
  typename S::V charge, dispersion;
};

/// S::over_root gives 1/r from these two, and 0 where s is.
/// @param s inverse squared distances, 0 where nothing acts
template <class S, bool kSums, ForceKind kKind, class Coefficients>
PairTerms<S> pair_terms(const Coefficients& coefficient, int p, typename S::V r2, typename S::V s,
                        const Products<S>& products, const Constants<S>& constants) {
  using V = typename S::V;
  const V charge = products.charge;
  PairTerms<S> terms = lennard_jones_terms < S, kSums || is_switched(kKind) > (coefficient, p, s);
  if constexpr (kSums && !is_switched(kKind) && !Coefficients::kMixes) {
    const V above = S::keep(S::less(S::zero(), s, 0xFFFF, p), coefficient(kEnergyShift, p));
    terms.energy = S::sub(terms.energy, above);
  }
  if constexpr (has_charges(kKind) || is_switched(kKind)) {
    const V over_r = S::over_root(r2, s);
    if constexpr (is_switched(kKind)) switch_off<S>(S::mul(r2, over_r), over_r, constants, terms);
    if constexpr (has_reaction_field(kKind))
      add_reaction_field<S, kSums>(r2, s, over_r, charge, constants, terms);
    if constexpr (has_ewald(kKind) && has_one_cutoff(kKind))
      add_ewald<S, kSums>(r2, s, over_r, charge, constants, terms);
    if constexpr (has_dispersion(kKind))
      add_dispersion<S, kSums>(coefficient, p, r2, s, products.dispersion, constants, terms);
    if constexpr (has_two_cutoffs(kKind)) {
      const auto is_near = S::less(r2, coefficient(kCutoff2, p), 0xFFFF, p);
      const auto charges_are_near = S::less(r2, coefficient(kCoulombCutoff2, p), 0xFFFF, p);
      const V bare = S::mul(charge, over_r);
      EwaldFactors<S> factors{bare, bare};
      if constexpr (kKind == ForceKind::ewald) {
        const EwaldFactors<S> ewald = ewald_factors<S>(S::mul(constants.splitting, S::mul(r2, over_r)));
        factors = {S::mul(bare, ewald.energy), S::mul(bare, ewald.force)};
      }
      terms.force =
          S::add(S::keep(is_near, terms.force), S::keep(charges_are_near, S::mul(factors.force, s)));
      if constexpr (kSums) {
        terms.energy = S::keep(is_near, terms.energy);
        terms.coulomb_energy = S::keep(charges_are_near, factors.energy);
      }
    }
  }
  return terms;
}

/// The terms of LennardJones as what the loops over pairs ask of a kind of force: which of the particles'
/// numbers and cutoffs it has, whether pairs at no distance act, and what a pair adds.
template <ForceKind kKind>
struct LjKind {
  static constexpr bool kHasCharges = has_charges(kKind), kHasDispersion = has_dispersion(kKind);
  static constexpr bool kHasOneCutoff = has_one_cutoff(kKind), kHasTwoCutoffs = has_two_cutoffs(kKind);
  static constexpr bool kActsAtZero = false;
  template <class S, bool kSums, class Coefficients>
  static PairTerms<S> terms(const Coefficients& coefficient, int p, typename S::V r2, typename S::V s,
                            const Products<S>& products, const Constants<S>& constants) {
    return pair_terms<S, kSums, kKind>(coefficient, p, r2, s, products, constants);
  }
};

}  // namespace
}  // namespace dch::detail
