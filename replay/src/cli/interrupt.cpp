// SPDX-License-Identifier: MIT
#include "interrupt.hpp"

#include <csignal>

#include <dch/trajectory/output_file.hpp>

#include "exit_code.hpp"

namespace dch::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

extern "C" void on_interrupt(int signal) {
  if (interrupted) {
    trajectory::remove_unfinished_files();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  interrupted = 1;
}

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    if (std::signal(signal, on_interrupt) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

void throw_if_interrupted() {
  if (interrupted) throw Interrupted();
}

}  // namespace dch::cli
