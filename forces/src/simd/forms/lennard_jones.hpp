// SPDX-License-Identifier: MIT
//
// 4 epsilon ((sigma/r)^12 - (sigma/r)^6), plain, at a distance from a surface, and switched off in two ways;
// see style.hpp.
#pragma once

#include "simd/forms/style.hpp"

namespace dch::detail {
namespace {

/// epsilon and sigma become 12 and 6 times the factors of the energy's powers, and these.
struct LennardJonesForm {
  static constexpr int kGiven = 2;
  static constexpr bool kActsAtZero = false, kMayBeShifted = true;

  static double prepare(const double* given, double, double* numbers) {
    const double sigma2 = given[1] * given[1], sigma6 = sigma2 * sigma2 * sigma2;
    numbers[2] = 4 * given[0] * sigma6 * sigma6;
    numbers[3] = 4 * given[0] * sigma6;
    numbers[0] = 12 * numbers[2];
    numbers[1] = 6 * numbers[3];
    return 0;
  }
  template <class S, class Coefficients>
  static FormTerms<S> terms(const Coefficients& coefficient, int p, const PairDistance<S>& at,
                            const Constants<S>&) {
    const PairTerms<S> terms = lennard_jones_terms<S, true>(coefficient, p, at.s);
    return {terms.force, terms.energy};
  }
};

/// epsilon, sigma and delta: r - delta is what acts as the distance.
struct ExpandedForm {
  static constexpr int kGiven = 3;
  static constexpr bool kActsAtZero = false, kMayBeShifted = true;

  static double prepare(const double* given, double cutoff, double* numbers) {
    double plain[4];
    LennardJonesForm::prepare(given, cutoff, plain);
    numbers[0] = plain[2];
    numbers[1] = plain[3];
    numbers[2] = given[2];
    return 0;
  }
  template <class S, class Coefficients>
  static FormTerms<S> terms(const Coefficients& coefficient, int p, const PairDistance<S>& at,
                            const Constants<S>&) {
    using V = typename S::V;
    using Real = typename S::Real;
    const V apart = S::sub(at.r, form_number<S>(coefficient, 2, p));
    const V s = S::keep(at.acts, S::inverse(S::mul(apart, apart))), s3 = S::mul(S::mul(s, s), s);
    const V repulsion = S::mul(form_number<S>(coefficient, 0, p), s3),
            attraction = form_number<S>(coefficient, 1, p);
    const V slope = S::msub(S::set1(Real(12)), repulsion, S::mul(S::set1(Real(6)), attraction));
    return {S::mul(S::mul(S::mul(s3, slope), S::mul(s, apart)), at.over_r),
            S::mul(s3, S::sub(repulsion, attraction))};
  }
};

/// epsilon and sigma, multiplied by a function of r^2 that falls from 1 to 0 between two distances that are
/// the same for all pairs. Of the form's numbers there are three: both squared, and one over the cube of
/// their difference.
struct CharmmForm {
  static constexpr int kGiven = 2;
  static constexpr bool kActsAtZero = false, kMayBeShifted = false;

  static double prepare(const double* given, double cutoff, double* numbers) {
    double plain[4];
    LennardJonesForm::prepare(given, cutoff, plain);
    numbers[0] = plain[2];
    numbers[1] = plain[3];
    return 0;
  }
  template <class S, class Coefficients>
  static FormTerms<S> terms(const Coefficients& coefficient, int p, const PairDistance<S>& at,
                            const Constants<S>& constants) {
    const FormTerms<S> whole = plain<S>(coefficient, p, at);
    const auto value = factor<S>(at, constants.of_form), slope = factor_slope<S>(at, constants.of_form);
    return {S::madd(value, whole.force, S::mul(slope, whole.energy)), S::mul(value, whole.energy)};
  }

  /// @param way  the three numbers
  template <class S>
  static typename S::V factor(const PairDistance<S>& at, const typename S::V* way) {
    using V = typename S::V;
    const V r2 = S::max(at.r2, way[0]), left = S::sub(way[1], r2);
    const V both = S::madd(S::set1(typename S::Real(3)), S::sub(r2, way[0]), left);
    return S::mul(S::mul(S::mul(left, way[2]), left), both);
  }
  /// The derivative of the factor by the distance, divided by that, with the other sign.
  template <class S>
  static typename S::V factor_slope(const PairDistance<S>& at, const typename S::V* way) {
    using V = typename S::V;
    const V r2 = S::max(at.r2, way[0]), rest = S::mul(S::sub(way[1], r2), way[2]);
    return S::mul(S::mul(S::set1(typename S::Real(12)), rest), S::sub(r2, way[0]));
  }

 protected:
  template <class S, class Coefficients>
  static FormTerms<S> plain(const Coefficients& coefficient, int p, const PairDistance<S>& at) {
    using V = typename S::V;
    using Real = typename S::Real;
    if constexpr (Coefficients::kMixes) {
      const PairTerms<S> mixed = lennard_jones_terms<S, true>(coefficient, p, at.s);
      return {mixed.force, mixed.energy};
    } else {
      const V s3 = S::mul(S::mul(at.s, at.s), at.s);
      const V repulsion = S::mul(form_number<S>(coefficient, 0, p), s3),
              attraction = form_number<S>(coefficient, 1, p);
      const V slope = S::msub(S::set1(Real(12)), repulsion, S::mul(S::set1(Real(6)), attraction));
      return {S::mul(S::mul(s3, at.s), slope), S::mul(s3, S::sub(repulsion, attraction))};
    }
  }
};

/// The same two. As in LAMMPS the force is that of Lennard-Jones times the factor, and the energy that of
/// another way to switch forces off, of which it is not the slope: beyond f, where that begins, the term
/// 1/r^2n is (1/r^n - 1/c^n)^2 / (1 - (f/c)^n), which ends at the cutoff c with slope 0, and within f it is
/// 1/r^2n - 1/(f c)^n (Steinbach and Brooks, J. Comput. Chem. 15:667, 1994). Of the form's numbers there are
/// four more: 1/c^3, 1 / (1 - (f/c)^6), 1 / (1 - (f/c)^3) and 1/(f c)^3.
struct CharmmForceForm : CharmmForm {
  template <class S, class Coefficients>
  static FormTerms<S> terms(const Coefficients& coefficient, int p, const PairDistance<S>& at,
                            const Constants<S>& constants) {
    using V = typename S::V;
    const V* const way = constants.of_form;
    const FormTerms<S> whole = plain<S>(coefficient, p, at);
    V repulsion, attraction;
    if constexpr (Coefficients::kMixes) {
      const V sigma = coefficient.sigma(p), sigma2 = S::mul(sigma, sigma);
      const V sigma6 = S::mul(S::mul(sigma2, sigma2), sigma2);
      attraction = S::mul(coefficient.four_epsilon(p), sigma6);
      repulsion = S::mul(attraction, sigma6);
    } else {
      repulsion = form_number<S>(coefficient, 0, p);
      attraction = form_number<S>(coefficient, 1, p);
    }
    const V near = S::sub(whole.energy, S::mul(way[6], S::msub(repulsion, way[6], attraction)));
    const V over_r3 = S::mul(at.s, at.over_r), less = S::sub(over_r3, way[3]), more = S::add(over_r3, way[3]);
    const V of_both = S::msub(S::mul(repulsion, way[4]), S::mul(more, more), S::mul(attraction, way[5]));
    const V far = S::mul(S::mul(less, less), of_both);
    const auto is_far = S::less(way[0], at.r2, 0xFFFF, 0);
    return {S::mul(factor<S>(at, way), whole.force), S::add(near, S::keep(is_far, S::sub(far, near)))};
  }
};

}  // namespace
}  // namespace dch::detail
