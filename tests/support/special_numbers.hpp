// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace dch {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace dch
