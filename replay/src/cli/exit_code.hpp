// SPDX-License-Identifier: MIT
#pragma once

#include <dch/error.hpp>

namespace dch::cli {

/// Exit statuses of the dch command.
enum ExitCode : int {
  kOk = 0,
  kMismatch = 1,      ///< --verify found a list or a structure that differs from the oracle
  kUsage = 2,         ///< an option, or a combination of options and input, that cannot work
  kBadFile = 3,       ///< a file that cannot be read or written, or is broken
  kInterrupted = 130  ///< SIGINT or SIGTERM, as shells report it
};

/// An option outside its range, or one that does not fit the input. The message names value, limit and
/// remedy.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// The user stopped the program (SIGINT, SIGTERM).
class Interrupted : public Error {
 public:
  Interrupted() : Error("interrupted; no output file was written") {}
};

}  // namespace dch::cli
