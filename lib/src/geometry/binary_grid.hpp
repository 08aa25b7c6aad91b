// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace dch::detail {

/// Rounds to multiples of a power of two about 10,000 times smaller than a length, so that sums and
/// differences of such numbers are exact: in single precision up to 1000 of these lengths.
class BinaryGrid {
 public:
  explicit BinaryGrid(double length) : shift_(0x1.8p52 * std::ldexp(1, std::ilogb(length) - 13)) {}
  /// Of a number far below 2^51 multiples; larger ones are on the grid anyway, or left as they are.
  /// What operator() adds and takes off again.
  double addend() const { return shift_; }
  double operator()(double v) const { return (v + shift_) - shift_; }

 private:
  double shift_;
};

}  // namespace dch::detail
