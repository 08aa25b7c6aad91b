// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace dch {

/// How often a random test does its step, or how many points it takes: `full`, but an eighth of that under
/// sanitizers and a quarter where lines are counted, which take so many times as long.
constexpr int effort(int full) {
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
  return std::max(1, full / 8);
#elif defined(DCH_COUNTS_LINES)
  return std::max(1, full / 4);
#else
  return full;
#endif
}

}  // namespace dch
