// SPDX-License-Identifier: MIT
#include "base/standard_streams.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

#include "base/exit_code.hpp"

namespace dch::cli {
namespace {

int output_error = 0;  ///< errno of the first write of results that failed

void note_output(bool good) {
  if (!good && output_error == 0) output_error = errno;
}

}  // namespace

void prepare_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) >= 0) continue;
    // The lowest free number is this one. Opened the wrong way round: use of it fails, as of a closed one.
    const int mode = descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (::open("/dev/null", mode) != descriptor) std::_Exit(kBadFile);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void write_output(std::string_view text) {
  note_output(std::fwrite(text.data(), 1, text.size(), stdout) == text.size());
}

void write_message(std::initializer_list<std::string_view> parts) noexcept {
  note_output(std::fflush(stdout) == 0);  // what came before stays before where both go to one place
  for (const std::string_view part : parts) std::fwrite(part.data(), 1, part.size(), stderr);
  std::fflush(stderr);
}

int finish_output(int exit_code) {
  note_output(std::fflush(stdout) == 0);
  if (output_error == 0) return exit_code;
  if (output_error != EPIPE) {
    write_message({"dchmd: standard output: cannot be written: ", std::strerror(output_error),
                   "; check the free space of where it leads\n"});
  }
  if (exit_code != kOk) return exit_code;
  return output_error == EPIPE ? kBrokenPipe : kBadFile;
}

}  // namespace dch::cli
