// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace dch::forms {

/// A number and its derivative with respect to the distance.
struct Dual {
  double value, slope;
  Dual(double v, double s = 0) : value(v), slope(s) {}
};
inline Dual operator+(Dual a, Dual b) { return {a.value + b.value, a.slope + b.slope}; }
inline Dual operator-(Dual a, Dual b) { return {a.value - b.value, a.slope - b.slope}; }
inline Dual operator*(Dual a, Dual b) { return {a.value * b.value, a.slope * b.value + a.value * b.slope}; }
inline Dual operator/(Dual a, Dual b) {
  return {a.value / b.value, (a.slope * b.value - a.value * b.slope) / (b.value * b.value)};
}
inline Dual exp(Dual a) { return {std::exp(a.value), std::exp(a.value) * a.slope}; }
inline Dual log(Dual a) { return {std::log(a.value), a.slope / a.value}; }
inline Dual cos(Dual a) { return {std::cos(a.value), -std::sin(a.value) * a.slope}; }
inline Dual erfc(Dual a) {
  return {std::erfc(a.value), -2 / std::sqrt(std::acos(-1.0)) * std::exp(-a.value * a.value) * a.slope};
}

}  // namespace dch::forms
