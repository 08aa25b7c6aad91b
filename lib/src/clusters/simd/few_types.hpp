// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace dch::detail {

/// Tables of this many types fit into registers, which is faster than memory.
inline constexpr std::int32_t kFewTypes = 4;

}  // namespace dch::detail
