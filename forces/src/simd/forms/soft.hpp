// SPDX-License-Identifier: MIT
#pragma once

#include "simd/forms/style.hpp"

namespace dch::detail {
namespace {

/// a (1 + cos(pi r / cutoff)), of a. Cosine and sine over the argument are smooth in r^2, so pairs at no
/// distance act as others do. In tables stand a (pi / cutoff)^2, (pi / cutoff)^2 and a.
struct SoftForm {
  static constexpr int kGiven = 1;
  static constexpr bool kActsAtZero = true, kMayBeShifted = false;

  static double prepare(const double* given, double cutoff, double* numbers) {
    constexpr double kPi = 3.14159265358979323846;
    numbers[1] = kPi / cutoff * (kPi / cutoff);
    numbers[0] = given[0] * numbers[1];
    numbers[2] = given[0];
    return 0;
  }
  template <class S, class Coefficients>
  static FormTerms<S> terms(const Coefficients& coefficient, int p, const PairDistance<S>& at,
                            const Constants<S>&) {
    using V = typename S::V;
    const V y = S::mul(at.r2, form_number<S>(coefficient, 1, p));
    const V force = S::mul(form_number<S>(coefficient, 0, p), series_of_sine<S>(y, 1));
    return {S::keep(at.acts, force),
            S::mul(form_number<S>(coefficient, 2, p), S::add(S::set1(1), series_of_sine<S>(y, 0)))};
  }

 private:
  /// The sum of (-y)^k / (2 k + odd)!, k = 0, 1, ..., for 0 <= y <= pi^2: with `odd` = 0 the cosine of the
  /// root of y, with 1 the sine of it over it.
  template <class S>
  static typename S::V series_of_sine(typename S::V y, int odd) {
    using Real = typename S::Real;
    constexpr int kTerms = sizeof(Real) == 4 ? 10 : 16;
    // Each term is the one before times -y / ((m - 1) m), m = 2 k + odd.
    typename S::V sum = S::set1(1);
    for (int k = kTerms - 1; k > 0; --k) {
      const double m = 2 * k + odd;
      sum = S::madd(S::mul(sum, y), S::set1(static_cast<Real>(-1 / ((m - 1) * m))), S::set1(1));
    }
    return sum;
  }
};

}  // namespace
}  // namespace dch::detail
