// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace dch::detail {

// Constants of Philox4x32 (Salmon et al., SC 2011, section 4.3).
inline constexpr int kPhiloxRounds = 10;
inline constexpr std::uint32_t kPhiloxFactors[2] = {0xD2511F53, 0xCD9E8D57};
inline constexpr std::uint32_t kPhiloxSteps[2] = {0x9E3779B9, 0xBB67AE85};  ///< of the key, each round

}  // namespace dch::detail
