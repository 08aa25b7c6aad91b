// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>

#include <dch/base/vec3.hpp>

#include "vectors.hpp"

namespace dch::zonotope {

/// mantissa 2^exponent: sums and products of doubles without rounding. There is no division; signs of
/// polynomials are all that the predicates need, and powers of two never call for a common denominator.
class Exact {
 public:
  using Integer = boost::multiprecision::cpp_int;

  Exact() = default;
  Exact(double value) {  // doubles are numbers of this type
    if (value == 0) return;
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);
    auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, 53));
    exponent_ = exponent - 53;
    while (mantissa % 2 == 0) {  // short mantissas are multiplied faster
      mantissa /= 2;
      ++exponent_;
    }
    mantissa_ = mantissa;
  }

  int sign() const { return mantissa_.sign(); }
  /// Rounded, for what is shown or guessed.
  double value() const {
    if (sign() == 0) return 0;
    const Integer magnitude = sign() < 0 ? Integer(-mantissa_) : mantissa_;
    const int bits = static_cast<int>(msb(magnitude)) + 1, cut = std::max(0, bits - 64);
    const auto top = static_cast<double>(static_cast<std::uint64_t>(magnitude >> static_cast<unsigned>(cut)));
    return std::ldexp(sign() * top, exponent_ + cut);
  }

  friend Exact operator*(const Exact& a, const Exact& b) {
    return {a.mantissa_ * b.mantissa_, a.exponent_ + b.exponent_};
  }
  friend Exact operator+(const Exact& a, const Exact& b) {
    if (a.sign() == 0) return b;
    if (b.sign() == 0) return a;
    if (a.exponent_ >= b.exponent_) return {a.at(b.exponent_) + b.mantissa_, b.exponent_};
    return {a.mantissa_ + b.at(a.exponent_), a.exponent_};
  }
  friend Exact operator-(const Exact& a) { return {Integer(-a.mantissa_), a.exponent_}; }
  friend Exact operator-(const Exact& a, const Exact& b) { return a + (-b); }

 private:
  Exact(Integer mantissa, int exponent) : mantissa_(std::move(mantissa)), exponent_(exponent) {}
  Integer at(int exponent) const { return mantissa_ << static_cast<unsigned>(exponent_ - exponent); }

  Integer mantissa_ = 0;
  int exponent_ = 0;
};

inline int sign_of(const Exact& x) { return x.sign(); }
inline double value_of(const Exact& x) { return x.value(); }

using ExactVec = Vec<Exact>;

inline ExactVec exact(Vec3 v) { return {v.x, v.y, v.z}; }

}  // namespace dch::zonotope
