// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <fmt/format.h>
#include <string>

#include <dch/base/error.hpp>
#include <dch/trajectory/file_error.hpp>

#include "base/exit_code.hpp"

namespace dch::cli {

/// Gives what a call gives that takes a frame; errors of the library come to name the frame.
/// @throws trajectory::FileError for positions and boxes that are not valid, UsageError for options that do
///   not fit the frame.
template <class Call>
auto in_frame(const std::string& file, std::int64_t index, const Call& call) {
  const auto place = [&](const Error& error) {
    return fmt::format("{}: frame {}: {}", file, index, error.what());
  };
  try {
    return call();
  } catch (const InvalidPosition& error) {
    throw trajectory::FileError(place(error));
  } catch (const InvalidBox& error) {
    throw trajectory::FileError(place(error));
  } catch (const Error& error) {
    throw UsageError(place(error));
  }
}

}  // namespace dch::cli
