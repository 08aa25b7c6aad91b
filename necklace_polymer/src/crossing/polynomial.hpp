// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "crossing/integer.hpp"

namespace dch::necklace::detail {

/// numerator / 2^exponent
struct Dyadic {
  Integer numerator;
  std::size_t exponent = 0;

  double value() const;
};

/// A polynomial with integer coefficients, that of t^k at place k; the last is not 0. Zero has none.
class Polynomial {
 public:
  Polynomial() = default;
  explicit Polynomial(std::vector<Integer> coefficients);

  bool is_zero() const { return c_.empty(); }
  /// -1 of zero.
  int degree() const { return static_cast<int>(c_.size()) - 1; }
  const Integer& leading() const { return c_.back(); }
  /// The value at t, times 2^(t.exponent * degree) for the degree given, at least that of the polynomial.
  Integer value_at(const Dyadic& t, int degree) const;
  int sign_at(const Dyadic& t) const { return value_at(t, degree()).sign(); }
  Polynomial derivative() const;
  Polynomial negative() const;

  friend Polynomial operator+(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + b.negative(); }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);
  /// What remains of a positive multiple of a when divided by b, which is not zero.
  friend Polynomial remainder(Polynomial a, const Polynomial& b);

 private:
  void trim();

  std::vector<Integer> c_;
};

/// The signed remainder sequence of p and p' g. By the theorem of Sturm and Tarski (Basu, Pollack, Roy,
/// Algorithms in Real Algebraic Geometry, theorem 2.61) it gives the number of roots of p in (a, b) with g >
/// 0 less that of those with g < 0, if neither a nor b is a root.
class TarskiQuery {
 public:
  TarskiQuery(const Polynomial& p, const Polynomial& g);

  int between(const Dyadic& a, const Dyadic& b) const { return variations(a) - variations(b); }
  /// Whether p has a multiple root, for g = 1.
  bool has_common_factor() const { return sequence_.back().degree() > 0; }

 private:
  int variations(const Dyadic& t) const;

  std::vector<Polynomial> sequence_;
};

/// An interval with exactly one root of a polynomial in it and none at its ends.
struct RootInterval {
  Dyadic low, high;
};

/// The roots in (0, 1) of a polynomial without multiple roots, whose sequence with g = 1 is `count`, in
/// ascending order. None may be at 0 or 1.
std::vector<RootInterval> isolate_roots(const Polynomial& p, const TarskiQuery& count);

/// Makes the interval of a simple root narrower than 2^-bits.
void narrow(const Polynomial& p, RootInterval& root, std::size_t bits);

}  // namespace dch::necklace::detail
