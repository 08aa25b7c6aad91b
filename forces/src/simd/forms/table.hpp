// SPDX-License-Identifier: MIT
#pragma once

#include "simd/forms/knots.hpp"
#include "simd/forms/style.hpp"

namespace dch::detail {
namespace {

/// Where pairs stand in a PairTable. Given are the square of the first knot's distance, knots per length^2,
/// and where the table begins among the knots of all: with one of its own that is no number, so that no pair
/// closer than the first one of PairTable has a force. Beyond the last one are more, as many as rounding may
/// be off.
/// @tparam Form  says by between() what a table is between two knots
template <class Form>
struct OfTables {
  static constexpr int kGiven = 3;
  static constexpr bool kActsAtZero = true, kMayBeShifted = false;

  static double prepare(const double* given, double, double* numbers) {
    for (int n = 0; n < kGiven; ++n) numbers[n] = given[n];
    return 0;
  }

  template <class S, class Coefficients>
  static FormTerms<S> terms(const Coefficients& coefficient, int p, const PairDistance<S>& at,
                            const Constants<S>& constants) {
    const Place<S> place(coefficient, p, at);
    return {S::keep(at.acts, Form::template between<S>(constants.series->table_force, place)),
            Form::template between<S>(constants.series->table_energy, place)};
  }

 protected:
  template <class S>
  struct Place {
    typename S::V knot, part;  ///< among the knots of all; of the way to the next one

    template <class Coefficients>
    Place(const Coefficients& coefficient, int p, const PairDistance<S>& at) {
      using V = typename S::V;
      const V beyond_first = S::sub(S::keep(at.acts, at.r2), form_number<S>(coefficient, 0, p));
      const V along = S::madd(beyond_first, form_number<S>(coefficient, 1, p), S::set1(1));
      const V within = S::max(along, S::zero()), whole = S::floor(within);
      part = S::sub(within, whole);
      knot = S::add(whole, form_number<S>(coefficient, 2, p));
    }
  };
};

/// Linear in r^2 between knots.
struct TableForm : OfTables<TableForm> {
  template <class S>
  static typename S::V between(const typename S::Real* table, const Place<S>& place) {
    typename S::V first, second;
    S::gather_two(table, place.knot, first, second);
    return S::madd(place.part, S::sub(second, first), first);
  }
};

/// A cubic spline of r^2. A knot has two numbers: its value y, and its bend, the second derivative by r^2
/// times -d^2 / 6, where d is the step in r^2 from knot to knot. At the part b of a step, with a = 1 - b, it
/// is a y0 + b y1 + a b ((1 + a) bend0 + (1 + b) bend1).
struct SplineForm : OfTables<SplineForm> {
  template <class S>
  static typename S::V between(const typename S::Real* table, const Place<S>& place) {
    using V = typename S::V;
    V knots[4];  // value and bend of the first, and of the second
    TwoKnots<S>::load(table, place.knot, knots);
    const V b = place.part, a = S::sub(S::set1(1), b);
    const V bends = S::add(S::madd(a, knots[1], knots[1]), S::madd(b, knots[3], knots[3]));
    return S::madd(S::mul(a, b), bends, S::madd(b, S::sub(knots[2], knots[0]), knots[0]));
  }
};

}  // namespace
}  // namespace dch::detail
