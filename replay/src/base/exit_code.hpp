// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/error.hpp>

namespace dch::cli {

/// Exit statuses of the command dchmd.
enum ExitCode : int {
  kOk = 0,
  kMismatch = 1,     ///< --verify found a list or a structure that differs from the oracle
  kUsage = 2,        ///< an option, or a combination of options and input, that cannot work
  kBadFile = 3,      ///< a file that cannot be read or written, or is broken; standard output too
  kSignal = 128,     ///< plus the number of the signal that ended the run, as shells report it
  kBrokenPipe = 141  ///< the reader of standard output has gone: 128 and SIGPIPE
};

/// An option outside its range, or one that does not fit the input. The message names value, limit and
/// remedy.
class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace dch::cli
