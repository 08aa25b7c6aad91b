// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace dch {

/// How often a random test does its step, or how many points it takes: `full`, but a quarter of that under
/// sanitizers and where lines are counted, which takes several times as long.
constexpr int effort(int full) {
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__) || defined(DCH_COUNTS_LINES)
  return std::max(1, full / 4);
#else
  return full;
#endif
}

}  // namespace dch
