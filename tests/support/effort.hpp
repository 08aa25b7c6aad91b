// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace dch {

/// How often a random test does its step: `full` times, but a quarter of that under the thread sanitizer,
/// which takes ten times as long and has nothing to find in a single thread.
constexpr int effort(int full) {
#ifdef __SANITIZE_THREAD__
  return std::max(1, full / 4);
#else
  return full;
#endif
}

}  // namespace dch
