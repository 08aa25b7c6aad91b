// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dch::necklace::detail {

/// An integer of any size, with what the exact decisions about crossings need: no division, and schoolbook
/// products, since their numbers have some hundred bits and are rare.
class Integer {
 public:
  Integer() = default;
  Integer(std::int64_t value);

  int sign() const { return limbs_.empty() ? 0 : negative_ ? -1 : 1; }
  /// Bits of the magnitude; 0 of zero.
  std::size_t bits() const;
  /// Nearest double or one beside it; the exponent is that of the number times 2^-shift.
  double scaled(std::size_t shift) const;

  Integer operator-() const;
  Integer& operator+=(const Integer& other) { return add(other, other.negative_); }
  Integer& operator-=(const Integer& other) { return add(other, !other.negative_); }
  Integer& operator<<=(std::size_t bits);
  friend Integer operator+(Integer a, const Integer& b) { return a += b; }
  friend Integer operator-(Integer a, const Integer& b) { return a -= b; }
  friend Integer operator*(const Integer& a, const Integer& b);
  friend Integer operator<<(Integer a, std::size_t bits) { return a <<= bits; }

 private:
  Integer& add(const Integer& other, bool other_negative);
  void trim();

  std::vector<std::uint32_t> limbs_;  ///< lowest first, the last one is not 0
  bool negative_ = false;
};

}  // namespace dch::necklace::detail
