// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "charged_tree.hpp"
#include "geometry/tolerance.hpp"
#include "moment_sizes.hpp"

namespace dch::detail {

/// Orders below the highest are taken if the error is this part of what it may be. Else all pairs would have
/// errors near the limit, so that fewer of them could be taken.
inline constexpr double kShareOfLower = 0.1;

/// No node is expected to have moments that are all below this part of what its absolute charges have at
/// most; one that has is split, which costs time alone.
inline constexpr double kSmallMoments = 0.01;

/// Whether a pair of nodes can be taken by expansions, of which order, and the error then.
struct Expanded {
  bool is_far = false;
  int order = 0;
  double error = 0;
};

/// How far sums by expansions up to a total degree may be off, and how large sums are at least.
///
/// For a charge at b - v and a target at a + u with R = |a - b| and d = |u - v| < R, the term of degree l of
/// exp(-kappa r) / r is largest where R and u - v point against each other: by the addition theorem it is a
/// sum over Legendre polynomials of the angle with positive factors (Watson, Bessel functions, 11.41). There
/// it is the Taylor series of exp(-kappa (R - s)) / (R - s) in s = d, whose terms are
///
///   exp(-x) / R t^l e_l(x),   t = d / R, x = kappa R, e_l(x) = sum over k <= l of x^k / k!
///
/// Those beyond the order p sum up to at most
///
///   t^(p+1) / (R - d) (exp(-x) e_(p+1)(x) + t x^(p+2) / (p+2)! exp(-x) g),
///
/// for 1/r to t^(p+1) / (R - d), where g is the smaller one of exp(t x) and, if that is positive,
/// 1 / (1 - t x / (p + 3)). The mean over charges of d^(p+1) is, by Minkowski's inequality, at most that
/// of the sum of the target's radius and of the power mean of the charges' distances from b.
///
/// For 1/r the moments of the charges, as measured, say more. What those of degree j add to the local
/// expansion in degree i is, with Racah's normalization and the centers on the axis, diagonal in m: M_j^m
/// times (i + j)! / sqrt((i + m)! (i - m)! (j + m)! (j - m)!) / R^(i+j+1), which is largest for m = 0
/// (Hobson, Spherical and Ellipsoidal Harmonics, 89). A rotation leaves the sum over m of squares as it is,
/// and that over the harmonics of degree i at u is |u|^(2i). So by Cauchy's inequality the terms of degree l
/// are at most
///
///   sum over i + j = l of binomial(l, i) |u|^i |M_j| / R^(l+1),
///
/// where |M_j| is at most the sum of |q| |v|^j, and far smaller for most charges. They are summed up to some
/// degrees above the order; those beyond sum up to what is said above for that degree.
class Truncation {
 public:
  Truncation(int order, double kappa) : order_(order), kappa_(kappa) {}

  double kappa() const { return kappa_; }
  /// Up to which moments count.
  int degree() const { return kappa_ > 0 ? order_ : order_ + kMaxDegree - kMaxOrder; }
  double kernel(double r) const { return (kappa_ > 0 ? std::exp(-kappa_ * r) : 1.0) / r; }

  /// The least order at which the error of the potential, within `radius` of a center that is `apart` from
  /// the source's own, is small enough; -1 if the source may as well be left out.
  Expanded lowest_order(const ChargedNode& source, double apart, double radius, double most) const {
    const double farthest = radius + source.radius, gap = apart / kInflate - farthest;
    if (!(gap > 0)) return {};
    if (kappa_ == 0) return lowest_harmonic(source, apart, radius, most);
    const double t = (radius + source.reach) / apart, x = kappa_ * apart;
    const double decay = std::exp(-x);
    const double of_gap = std::exp(-kappa_ * gap), ratio = kappa_ * farthest;
    const double left_out = source.weight / gap * of_gap;
    if (left_out <= kShareOfLower * most) return {true, -1, left_out};
    double power = source.weight / gap * t, term = x, sum = 1 + x;
    for (int order = 0; order <= order_; ++order, power *= t) {
      const double growth = ratio < order + 3 ? std::min(of_gap, decay / (1 - ratio / (order + 3))) : of_gap;
      term *= x / (order + 2);
      const double error = power * (decay * sum + farthest / apart * term * growth);
      sum += term;
      if (error <= (order < order_ ? kShareOfLower * most : most)) return {true, order, error};
    }
    return {};
  }

  /// The sum over absolute charges of the kernel is at least this: it is convex, so no smaller than at their
  /// mean distance, which is at most the root of the mean of squares.
  double least(const ChargedNode& source, double apart, double radius) const {
    const double farthest = apart + radius;
    return source.weight * kernel(std::sqrt(farthest * farthest + source.spread2));
  }

 private:
  /// From the highest degree down.
  Expanded lowest_harmonic(const ChargedNode& source, double apart, double radius, double most) const {
    const double inverse = kInflate / apart, gap = apart / kInflate - (radius + source.radius);
    const double weight = source.weight * inverse, t = (radius + source.reach) * inverse;
    const double above = power_of(t, order_ + 1);
    if (kSmallMoments * weight * above > most) return {};
    double error = source.weight / gap * above * power_of(t, degree() - order_);
    if (error > most) return {};
    constexpr std::size_t kDegrees = kMaxDegree + 1;
    std::array<double, kDegrees> of_source;
    std::array<double, 2 * kDegrees> of_target;  // of negative degrees 0, so that all sums are equally long
    const auto degrees = static_cast<std::size_t>(degree()) + 1;
    double power = weight, target_power = 1;
    for (std::size_t l = 0; l < degrees; ++l) {
      of_source[l] = power * double{source.moments[l]};
      of_target[kDegrees - l] = 0;
      of_target[kDegrees + l] = target_power * kOverFactorial[l];
      power *= source.radius * inverse;
      target_power *= radius * inverse;
    }
    Expanded lowest;
    for (int l = degree(); l >= 0; --l) {
      const double* const facing = of_target.data() + kDegrees + l;
      double even = 0, odd = of_source[0] * facing[0];
      for (std::size_t j = 1; j < degrees; j += 2) {
        even += of_source[j] * *(facing - j);
        if (j + 1 < degrees) odd += of_source[j + 1] * *(facing - j - 1);
      }
      error += (even + odd) * kFactorial[static_cast<std::size_t>(l)];
      if (error > (l - 1 < order_ ? kShareOfLower * most : most)) break;
      if (l - 1 <= order_) lowest = {true, l - 1, error};
    }
    return lowest;
  }

  static double power_of(double t, int exponent) {
    double power = 1;
    for (; exponent > 0; exponent >>= 1, t *= t)
      if ((exponent & 1) != 0) power *= t;
    return power;
  }

  static constexpr std::array<double, kMaxDegree + 1> kFactorial = [] {
    std::array<double, kMaxDegree + 1> table{1};
    for (std::size_t l = 1; l < table.size(); ++l) table[l] = table[l - 1] * static_cast<double>(l);
    return table;
  }();
  static constexpr std::array<double, kMaxDegree + 1> kOverFactorial = [] {
    std::array<double, kMaxDegree + 1> table{1};
    for (std::size_t l = 1; l < table.size(); ++l) table[l] = table[l - 1] / static_cast<double>(l);
    return table;
  }();

  int order_;
  double kappa_;
};

}  // namespace dch::detail
