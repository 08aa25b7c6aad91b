// SPDX-License-Identifier: MIT
#pragma once

#include "simd/forms/style.hpp"

namespace dch::detail {
namespace {

/// A PairTable: linear in r^2 between knots. Given are the square of the first one's distance, knots per
/// length^2, and where the table begins among all: with a knot of its own that is no number, so that no pair
/// closer than the first one of PairTable has a force. Beyond the last one are more, as many as rounding may
/// be off.
struct TableForm {
  static constexpr int kGiven = 3;
  static constexpr bool kActsAtZero = true, kMayBeShifted = false;

  static double prepare(const double* given, double, double* numbers) {
    for (int n = 0; n < kGiven; ++n) numbers[n] = given[n];
    return 0;
  }
  template <class S, class Coefficients>
  static FormTerms<S> terms(const Coefficients& coefficient, int p, const PairDistance<S>& at,
                            const Constants<S>& constants) {
    using V = typename S::V;
    const V beyond_first = S::sub(S::keep(at.acts, at.r2), form_number<S>(coefficient, 0, p));
    const V along = S::madd(beyond_first, form_number<S>(coefficient, 1, p), S::set1(1));
    const V within = S::max(along, S::zero()), knot = S::floor(within), part = S::sub(within, knot);
    const V place = S::add(knot, form_number<S>(coefficient, 2, p));
    return {S::keep(at.acts, between<S>(constants.series->table_force, place, part)),
            between<S>(constants.series->table_energy, place, part)};
  }

 private:
  template <class S>
  static typename S::V between(const typename S::Real* table, typename S::V place, typename S::V part) {
    typename S::V first, second;
    S::gather_two(table, place, first, second);
    return S::madd(part, S::sub(second, first), first);
  }
};

}  // namespace
}  // namespace dch::detail
