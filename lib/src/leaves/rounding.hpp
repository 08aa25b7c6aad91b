// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>

namespace dch::detail {

/// The finest unit [length] in which a difference of coordinates of at most `widest` is a 16-bit integer,
/// with room for the rounding of both.
inline double finest_unit(double widest) {
  constexpr double kMaxUnits = 32700;
  return widest * (1 + 1e-9) / kMaxUnits;
}

/// The nearest integer, modulo 2^16, of a number below 2^22 or 2^51 in magnitude.
inline std::int16_t rounded(float v) {
  const float shifted = v + 0x1.8p23f;  // now the integer stands in the low bits
  std::int32_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
}
inline std::int16_t rounded(double v) {
  const double shifted = v + 0x1.8p52;
  std::int64_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
}

}  // namespace dch::detail
