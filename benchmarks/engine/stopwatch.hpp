// SPDX-License-Identifier: MIT
#pragma once

#include <ctime>

namespace dch::bench {

/// What passes while a call runs. Time of processors is not disturbed by other programs that take turns.
enum class Clock : clockid_t {
  thread = CLOCK_THREAD_CPUTIME_ID,    ///< time of processors spent on this thread
  process = CLOCK_PROCESS_CPUTIME_ID,  ///< on all threads of this program
  wall = CLOCK_MONOTONIC               ///< for calls that use several threads at once
};

/// Seconds that a call takes.
template <class Call>
double seconds_of(const Call& call, Clock clock = Clock::thread) {
  const auto now = [clock] {
    std::timespec time{};
    clock_gettime(static_cast<clockid_t>(clock), &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double start = now();
  call();
  return now() - start;
}

}  // namespace dch::bench
