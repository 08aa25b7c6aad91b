// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

#include "simd/form_kernels.hpp"
#include "simd/forms/style.hpp"

namespace dch::detail {
namespace {

/// Spheres made of particles of Lennard-Jones, by Everaers and Ejtehadi, Phys. Rev. E 67, 041710 (2003).
/// Given are the Hamaker constant A [energy], sigma, and both diameters [length]; a particle of the solvent
/// has the diameter 0. Each pair of types has one of three formulas: of two particles of the solvent, of one
/// and a sphere of radius a, and of spheres of radii a <= b. In tables stand, in this order,
///
///     solvent            A sigma^12 / 3    A sigma^6 / 6    0    0
///     one sphere         A sigma^3 a^3     sigma^6          0    a
///     spheres            A                 sigma^6          a    b
///
/// so the last number tells whether there is a sphere. Most pairs of a solution are of the solvent, and
/// registers whose pairs all are skip the other formulas. A center within a sphere, or spheres that overlap,
/// have no number (NaN) as their force.
struct ColloidForm {
  static constexpr int kGiven = 4;
  static constexpr bool kActsAtZero = false, kMayBeShifted = true;

  static double prepare(const double* given, double, double* numbers) {
    const double hamaker = given[0], sigma3 = given[1] * given[1] * given[1], sigma6 = sigma3 * sigma3;
    const double smaller = 0.5 * std::min(given[2], given[3]), larger = 0.5 * std::max(given[2], given[3]);
    if (larger == 0) {
      numbers[0] = hamaker / 3 * sigma6 * sigma6;
      numbers[1] = hamaker / 6 * sigma6;
    } else {
      numbers[0] = smaller == 0 ? hamaker * sigma3 * larger * larger * larger : hamaker;
      numbers[1] = sigma6;
    }
    numbers[2] = smaller;
    numbers[3] = larger;
    return 0;
  }

  template <class S, class Coefficients>
  static FormTerms<S> terms(const Coefficients& coefficient, int p, const PairDistance<S>& at,
                            const Constants<S>&) {
    using V = typename S::V;
    using Real = typename S::Real;
    const Numbers<S> of{form_number<S>(coefficient, 0, p), form_number<S>(coefficient, 1, p)};
    const V larger = form_number<S>(coefficient, 3, p);
    const FormTerms<S> solvent = of_solvent<S>(of, at.s);
    const auto has_sphere = S::less(S::zero(), S::keep(at.acts, larger), 0xFFFF, 0);
    if (S::bits(has_sphere) == 0) return solvent;
    // Masks are not negated, but no radius is between 0 and this.
    const V least = S::set1(std::numeric_limits<Real>::min());
    const V smaller = form_number<S>(coefficient, 2, p);
    const auto has_none = S::less(larger, least, 0xFFFF, 0),
               has_less_than_two = S::less(smaller, least, 0xFFFF, 0);
    const FormTerms<S> one = of_one_sphere<S>(of, larger, at.r2);
    FormTerms<S> sum{
        S::add(S::keep(has_none, solvent.force), S::keep(has_sphere, S::keep(has_less_than_two, one.force))),
        S::add(S::keep(has_none, solvent.energy),
               S::keep(has_sphere, S::keep(has_less_than_two, one.energy)))};
    const auto has_two = S::less(S::zero(), S::keep(at.acts, smaller), 0xFFFF, 0);
    if (S::bits(has_two) != 0) {
      const FormTerms<S> two = of_spheres<S>(of, smaller, larger, at);
      sum = {S::add(sum.force, S::keep(has_two, two.force)),
             S::add(sum.energy, S::keep(has_two, two.energy))};
    }
    const V contact = S::add(smaller, larger);
    const auto overlaps = S::less(at.r2, S::keep(has_sphere, S::mul(contact, contact)), 0xFFFF, 0);
    sum.force = S::add(sum.force, S::keep(overlaps, S::set1(std::numeric_limits<Real>::quiet_NaN())));
    return sum;
  }

 private:
  template <class S>
  struct Numbers {
    typename S::V strength, sigma6;
  };

  template <class S>
  static typename S::V number(double value) {
    return S::set1(static_cast<typename S::Real>(value));
  }

  template <class S>
  static FormTerms<S> of_solvent(const Numbers<S>& of, typename S::V s) {
    using V = typename S::V;
    const V s3 = S::mul(S::mul(s, s), s);
    const V slope = S::msub(of.strength, s3, of.sigma6);
    const V energy =
        S::msub(S::mul(of.strength, number<S>(1.0 / 12)), s3, S::mul(of.sigma6, number<S>(1.0 / 6)));
    return {S::mul(S::mul(s3, s), slope), S::mul(s3, energy)};
  }

  /// With t = r^2 - a^2, of the strength C = A sigma^3 a^3: the energy is
  /// 2 C / (9 t^3) ((a^6/3 + 3 a^4 r^2 + 21/5 a^2 r^4 + r^6) sigma^6 / t^6 - 1).
  template <class S>
  static FormTerms<S> of_one_sphere(const Numbers<S>& of, typename S::V radius, typename S::V r2) {
    using V = typename S::V;
    const V a2 = S::mul(radius, radius), r4 = S::mul(r2, r2), q = S::inverse(S::sub(r2, a2));
    const V q3 = S::mul(S::mul(q, q), q), repulsion = S::mul(of.sigma6, S::mul(q3, q3));
    const V inner =
        S::madd(a2, S::madd(number<S>(5), a2, S::mul(number<S>(22), r2)), S::mul(number<S>(5), r4));
    const V slope = S::msub(S::mul(S::mul(number<S>(2), S::add(a2, r2)), inner), repulsion, number<S>(5));
    const V outer = S::madd(
        a2,
        S::madd(a2, S::madd(a2, number<S>(1.0 / 3), S::mul(number<S>(3), r2)), S::mul(number<S>(4.2), r4)),
        S::mul(r2, r4));
    const V of_t3 = S::mul(of.strength, q3);
    return {S::mul(S::mul(S::mul(of_t3, q), number<S>(4.0 / 15)), slope),
            S::mul(S::mul(of_t3, number<S>(2.0 / 9)), S::msub(outer, repulsion, number<S>(1)))};
  }

  /// What a repulsion of spheres adds for each distance D = r + c of points of their surfaces, c = +-(a+b),
  /// of the product m = a b, and c = +-(b-a), of m = -a b: (D^2 + 5 c D + 30 m) / D^7, and its derivative
  /// divided by -5.
  template <class S>
  static FormTerms<S> of_surfaces(typename S::V r, typename S::V c, typename S::V m) {
    using V = typename S::V;
    const V d = S::add(r, c), over = S::inverse(d), over2 = S::mul(over, over);
    const V over7 = S::mul(S::mul(over2, over2), S::mul(over2, over));
    const V energy = S::madd(S::madd(number<S>(5), c, d), d, S::mul(number<S>(30), m));
    const V force = S::madd(S::mul(number<S>(42), m), over, S::madd(number<S>(6), c, d));
    return {S::mul(force, over7), S::mul(energy, over7)};
  }

  /// Energies of repulsion, by of_surfaces, and of attraction, -A/6 (2 a b (u + v) + ln(v / u)). With u = 1 /
  /// (r^2 - (a+b)^2) and v = 1 / (r^2 - (b-a)^2), for which u - v = 4 a b u v, the force of attraction
  /// divided by r is -32/3 A (a b)^3 (u v)^2.
  template <class S>
  static FormTerms<S> of_spheres(const Numbers<S>& of, typename S::V a, typename S::V b,
                                 const PairDistance<S>& at) {
    using V = typename S::V;
    const V ab = S::mul(a, b), apart = S::add(a, b), less = S::sub(b, a);
    const auto minus = [](V x) { return S::sub(S::zero(), x); };
    const FormTerms<S> far = of_surfaces<S>(at.r, apart, ab), near = of_surfaces<S>(at.r, minus(apart), ab),
                       first = of_surfaces<S>(at.r, less, minus(ab)),
                       second = of_surfaces<S>(at.r, minus(less), minus(ab));
    const V scale = S::mul(S::mul(of.strength, of.sigma6), S::mul(at.over_r, number<S>(1.0 / 37800)));
    const V repulsion =
        S::mul(scale, S::sub(S::add(far.energy, near.energy), S::add(first.energy, second.energy)));
    const V slope = S::mul(scale, S::sub(S::add(far.force, near.force), S::add(first.force, second.force)));
    const V u = S::inverse(S::sub(at.r2, S::mul(apart, apart))),
            v = S::inverse(S::sub(at.r2, S::mul(less, less)));
    const V ab_uv = S::mul(ab, S::mul(u, v));
    const V pull = S::mul(S::mul(S::mul(of.strength, ab), number<S>(32.0 / 3)), S::mul(ab_uv, ab_uv));
    const V push = S::mul(at.over_r, S::madd(repulsion, at.over_r, S::mul(number<S>(5), slope)));
    const V of_parts = S::madd(S::mul(number<S>(2), ab), S::add(u, v),
                               logarithms_beside_one<S>(S::mul(S::mul(number<S>(-4), ab), v)));
    return {S::sub(push, pull), S::sub(repulsion, S::mul(S::mul(of.strength, number<S>(1.0 / 6)), of_parts))};
  }

  /// Of 1 + x.
  template <class S>
  static typename S::V logarithms_beside_one(typename S::V x) {
    alignas(64) typename S::Real lanes[S::kLanes];
    S::store(lanes, x);
    for (auto& lane : lanes) lane = static_cast<typename S::Real>(logarithm_beside_one(double{lane}));
    return S::load(lanes);
  }
};

}  // namespace
}  // namespace dch::detail
