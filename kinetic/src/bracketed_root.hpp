// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

namespace dch::kinetic {

/// The root of a function that is monotone between `low` and `high` and not of one sign there: Newton's steps
/// where they stay within the bracket, else halving. The last step is one of rounding.
/// @param value x -> f(x); not above zero counts as negative
/// @param slope x -> f'(x)
template <class Value, class Slope>
double bracketed_root(const Value& value, const Slope& slope, double low, double high) {
  constexpr int kMaxSteps = 200;  // halving alone gets to neighboring doubles sooner from brackets in use
  const bool rises = value(low) <= 0;
  double x = 0.5 * (low + high);
  for (int step = 0; step < kMaxSteps; ++step) {
    const double f = value(x);
    if ((f <= 0) == rises) {
      low = x;
    } else {
      high = x;
    }
    double next = x - f / slope(x);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= std::numeric_limits<double>::epsilon() * std::abs(x) || high - low <= 0)
      return next;
    x = next;
  }
  return x;
}

}  // namespace dch::kinetic
