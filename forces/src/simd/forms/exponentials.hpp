// SPDX-License-Identifier: MIT
//
// Forms with an exponential of the distance; see style.hpp.
#pragma once

#include "simd/forms/style.hpp"

namespace dch::detail {
namespace {

/// a e^(-r / rho) - c / r^6, of a, rho and c. In tables stand a, 1 / rho and c.
struct BuckinghamForm {
  static constexpr int kGiven = 3;
  static constexpr bool kActsAtZero = false, kMayBeShifted = true;

  static double prepare(const double* given, double, double* numbers) {
    numbers[0] = given[0];
    numbers[1] = 1 / given[1];
    numbers[2] = given[2];
    return 0;
  }
  template <class S, class Coefficients>
  static FormTerms<S> terms(const Coefficients& coefficient, int p, const PairDistance<S>& at,
                            const Constants<S>&) {
    using V = typename S::V;
    const V over_rho = form_number<S>(coefficient, 1, p);
    const V repulsion =
        S::mul(form_number<S>(coefficient, 0, p), exponential<S>(S::mul(S::sub(S::zero(), at.r), over_rho)));
    const V attraction = S::mul(form_number<S>(coefficient, 2, p), S::mul(S::mul(at.s, at.s), at.s));
    const V of_attraction = S::mul(S::mul(S::set1(6), attraction), at.s);
    return {S::msub(S::mul(repulsion, over_rho), at.over_r, of_attraction), S::sub(repulsion, attraction)};
  }
};

/// d (e^(-2 alpha (r - r0)) - 2 e^(-alpha (r - r0))), of d, alpha and r0.
struct MorseForm {
  static constexpr int kGiven = 3;
  static constexpr bool kActsAtZero = false, kMayBeShifted = true;

  static double prepare(const double* given, double, double* numbers) {
    for (int n = 0; n < kGiven; ++n) numbers[n] = given[n];
    return 2 * given[1] * given[2];
  }
  template <class S, class Coefficients>
  static FormTerms<S> terms(const Coefficients& coefficient, int p, const PairDistance<S>& at,
                            const Constants<S>&) {
    using V = typename S::V;
    const V depth = form_number<S>(coefficient, 0, p), alpha = form_number<S>(coefficient, 1, p);
    const V e = exponential<S>(S::mul(alpha, S::sub(form_number<S>(coefficient, 2, p), at.r)));
    const V of_depth = S::mul(depth, e), slope = S::mul(S::add(alpha, alpha), S::msub(of_depth, e, of_depth));
    return {S::mul(slope, at.over_r), S::mul(of_depth, S::sub(e, S::set1(2)))};
  }
};

/// a e^(-kappa r) / r, of a; kappa is the same for all pairs and the form's first number.
struct YukawaForm {
  static constexpr int kGiven = 1;
  static constexpr bool kActsAtZero = false, kMayBeShifted = true;

  static double prepare(const double* given, double, double* numbers) {
    numbers[0] = given[0];
    return 0;
  }
  template <class S, class Coefficients>
  static FormTerms<S> terms(const Coefficients& coefficient, int p, const PairDistance<S>& at,
                            const Constants<S>& constants) {
    using V = typename S::V;
    const V kappa = constants.of_form[0];
    const V screened =
        S::mul(form_number<S>(coefficient, 0, p), exponential<S>(S::mul(S::sub(S::zero(), at.r), kappa)));
    return {S::mul(S::mul(screened, at.s), S::add(kappa, at.over_r)), S::mul(screened, at.over_r)};
  }
};

}  // namespace
}  // namespace dch::detail
