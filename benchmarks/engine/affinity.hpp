// SPDX-License-Identifier: MIT
#pragma once

#include <sched.h>
#include <string>

#include <dch/base/error.hpp>

namespace dch::bench {

/// Keeps this thread, and those that it will start, on one processor.
/// @throws Error if there is no such processor for this program.
inline void pin_to(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(processor), &set);
  if (sched_setaffinity(0, sizeof set, &set) != 0)
    throw Error("cannot stay on processor " + std::to_string(processor) +
                "; choose another with --processor");
}

}  // namespace dch::bench
