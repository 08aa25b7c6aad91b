// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace dch::detail {

/// Nearest integer, an odd function (ties go to the even one). Needs no call to the mathematics library as
/// long as |x| < 2^51.
inline double nearest_integer(double x) {
  constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52: doubles of this size are integers
  return std::abs(x) < 2251799813685248.0 ? (x + kShift) - kShift : std::nearbyint(x);
}

}  // namespace dch::detail
