// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>
#include <memory>

#include <dch/base/executor.hpp>

namespace dch::cli {

/// From here on SIGINT, SIGTERM and SIGHUP remove the files that are not finished, print a line and end the
/// process at once, with the status that shells report for the signal (130, 143, 129), wherever it is: no
/// loop has to ask. Those that the process was started to ignore (nohup, jobs in the background) stay
/// ignored.
void catch_interrupts();

/// These signals wait while it lives: while something is half made that the handler does not know of.
class HoldInterrupts {
 public:
  HoldInterrupts();
  ~HoldInterrupts();
  HoldInterrupts(const HoldInterrupts&) = delete;
  HoldInterrupts& operator=(const HoldInterrupts&) = delete;

 private:
  sigset_t before_;
};

/// make_thread_pool() with threads that leave these signals to the thread that makes files.
std::unique_ptr<Executor> make_threads(int threads);

}  // namespace dch::cli
