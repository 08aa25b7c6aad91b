// SPDX-License-Identifier: MIT
#include "interrupt.hpp"

#include <csignal>

#include "exit_code.hpp"

namespace dch::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

extern "C" void set_interrupted(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);  // a second one ends the process at once
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, set_interrupted);
  std::signal(SIGTERM, set_interrupted);
}

void throw_if_interrupted() {
  if (interrupted) throw Interrupted();
}

}  // namespace dch::cli
