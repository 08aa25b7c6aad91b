// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace dch {

/// How often a random test does its step, or how many points it takes: `full`, but a quarter of that under
/// the thread sanitizer, which takes ten times as long and has nothing to find in a single thread, and half
/// of it under the address sanitizer.
constexpr int effort(int full) {
#ifdef __SANITIZE_THREAD__
  return std::max(1, full / 4);
#elif defined(__SANITIZE_ADDRESS__)
  return std::max(1, full / 2);
#else
  return full;
#endif
}

}  // namespace dch
