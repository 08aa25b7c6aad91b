// SPDX-License-Identifier: MIT
#include "base/interrupt.hpp"

#include <string_view>
#include <unistd.h>

#include <dch/trajectory/output_file.hpp>

#include "base/exit_code.hpp"

namespace dch::cli {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

bool bar_may_stand = false;  ///< on the terminal's line where the message goes

sigset_t signal_set() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : kSignals) sigaddset(&set, signal);
  return set;
}

/// A handler may call no more than this. A second signal finds the system's own handler and ends the process
/// whatever this one waits for (a reader of standard error, say).
extern "C" void end_process(int signal) {
  trajectory::remove_unfinished_files();
  constexpr std::string_view kWipe = "\r\x1b[K";
  constexpr std::string_view kMessage = "dchmd: interrupted; unfinished output files are removed\n";
  ssize_t ignored = bar_may_stand ? ::write(STDERR_FILENO, kWipe.data(), kWipe.size()) : 0;
  ignored += ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  static_cast<void>(ignored);
  ::_exit(kSignal + signal);
}

}  // namespace

void catch_interrupts() {
  bar_may_stand = ::isatty(STDERR_FILENO) == 1;
  struct sigaction action {};
  action.sa_handler = end_process;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (const int signal : kSignals) {
    struct sigaction before {};
    if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    ::sigaction(signal, &action, nullptr);
  }
}

HoldInterrupts::HoldInterrupts() {
  const sigset_t set = signal_set();
  ::pthread_sigmask(SIG_BLOCK, &set, &before_);
}

HoldInterrupts::~HoldInterrupts() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

std::unique_ptr<Executor> make_threads(int threads) {
  const HoldInterrupts hold;  // the new threads start with the signals held, and keep them so
  return make_thread_pool(threads);
}

}  // namespace dch::cli
