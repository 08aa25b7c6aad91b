// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace dch::detail {

// Constants of Ranmar (Marsaglia, Zaman, Tsang 1990; James 1990), whose numbers are multiples of 2^-24. A sum
// is the one of kRanmarLongLag before less that of kRanmarShortLag before, modulo 1, and a number is a sum
// less the shift, which falls by a step each time, modulo 1 - 3 * 2^-24.
inline constexpr std::size_t kRanmarLongLag = 97, kRanmarShortLag = 33;
inline constexpr std::int32_t kRanmarMask = 0xFFFFFF;  ///< modulo 2^24
inline constexpr std::int32_t kRanmarFirstShift = 362436, kRanmarShiftStep = 7654321;
inline constexpr std::int32_t kRanmarShiftModulus = 16777213;

/// The shift that comes after this one.
constexpr std::int32_t next_ranmar_shift(std::int32_t shift) {
  const std::int32_t less = shift - kRanmarShiftStep;
  return less < 0 ? less + kRanmarShiftModulus : less;
}

}  // namespace dch::detail
