// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <exception>
#include <fmt/format.h>

#include <dch/base/error.hpp>

namespace dch::bench {

/// What the programs end with.
enum ExitStatus {
  kOk = 0,
  kWrong = 1,   ///< an answer is not what it has to be
  kUsage = 2,   ///< wrong options
  kFailed = 3,  ///< a file that cannot be read or written, or another failure
};

/// An answer that is not what it has to be.
class WrongAnswer : public Error {
 public:
  using Error::Error;
};

/// Reads the options, does the work, and says on stderr why it was not done. Returns the exit status.
/// @param work returns an ExitStatus; may throw CLI::ValidationError for options that do not fit together
template <class Work>
int run_program(CLI::App& app, int argc, char** argv, const Work& work) {
  const auto failed = [&](const std::exception& error, ExitStatus status) {
    fmt::print(stderr, "{}: {}\n", app.get_name(), error.what());
    return status;
  };
  try {
    app.parse(argc, argv);
    return work();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kUsage;
  } catch (const WrongAnswer& error) {
    return failed(error, kWrong);
  } catch (const std::exception& error) {
    return failed(error, kFailed);
  }
}

}  // namespace dch::bench
