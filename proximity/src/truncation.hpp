// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "charged_tree.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {

/// Orders below the highest are taken if the error is this part of what it may be. Else all pairs would have
/// errors near the limit, so that fewer of them could be taken.
inline constexpr double kShareOfLower = 0.1;

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
class Truncation {
 public:
  Truncation(int order, double kappa) : order_(order), kappa_(kappa) {}

  double kappa() const { return kappa_; }
  double kernel(double r) const { return (kappa_ > 0 ? std::exp(-kappa_ * r) : 1.0) / r; }

  /// The least order at which the error of the potential, within `radius` of a center that is `apart` from
  /// the source's own, is small enough; -1 if the source may as well be left out.
  Expanded lowest_order(const ChargedNode& source, double apart, double radius, double most) const {
    const double farthest = radius + source.radius, gap = apart / kInflate - farthest;
    if (!(gap > 0)) return {};
    const double t = (radius + source.reach) / apart, x = kappa_ * apart;
    const double decay = kappa_ > 0 ? std::exp(-x) : 1;
    const double of_gap = kappa_ > 0 ? std::exp(-kappa_ * gap) : 1, ratio = kappa_ * farthest;
    const double left_out = source.weight / gap * of_gap;
    if (left_out <= kShareOfLower * most) return {true, -1, left_out};
    double power = source.weight / gap * t, term = x, sum = 1 + x;
    for (int order = 0; order <= order_; ++order, power *= t) {
      double terms = 1;
      if (kappa_ > 0) {
        const double growth =
            ratio < order + 3 ? std::min(of_gap, decay / (1 - ratio / (order + 3))) : of_gap;
        term *= x / (order + 2);
        terms = decay * sum + farthest / apart * term * growth;
        sum += term;
      }
      const double error = power * terms;
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
  int order_;
  double kappa_;
};

}  // namespace dch::detail
