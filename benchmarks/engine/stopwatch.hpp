// SPDX-License-Identifier: MIT
#pragma once

#include <ctime>

namespace dch::bench {

/// What passes while a call runs.
enum class Clock {
  thread,  ///< time that a processor spent on this thread: not disturbed by other programs that take turns
  wall     ///< for calls that use several threads
};

/// Seconds that a call takes.
template <class Call>
double seconds_of(const Call& call, Clock clock = Clock::thread) {
  const auto now = [clock] {
    std::timespec time{};
    clock_gettime(clock == Clock::thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double start = now();
  call();
  return now() - start;
}

}  // namespace dch::bench
