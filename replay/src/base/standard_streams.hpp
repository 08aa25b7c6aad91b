// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace dch::cli {

/// To be called before anything is opened. A standard stream that is closed becomes one that cannot be used,
/// so that no file of ours gets its number and messages in it; and a write that fails becomes an error, where
/// a signal would end the process (a pipe that nobody reads, a file beyond the limit of its size).
void prepare_standard_streams();

/// Prints results. A failure is kept for finish_output(), so that what has been asked for gets done first.
void write_output(std::string_view text);

/// Prints a message on standard error. One that cannot be shown is lost: it changes nothing else. Its parts
/// are not put together first, which takes memory: a message may be about that.
void write_message(std::initializer_list<std::string_view> parts) noexcept;

template <class... Values>
void print_output(fmt::format_string<Values...> format, Values&&... values) {
  write_output(fmt::format(format, std::forward<Values>(values)...));
}

template <class... Values>
void print_message(fmt::format_string<Values...> format, Values&&... values) {
  write_message({fmt::format(format, std::forward<Values>(values)...)});
}

/// Brings all results out and returns the exit status: `exit_code`, but if that is kOk and results could not
/// be printed, kBadFile with a message, or kBrokenPipe without one where the reader has gone, as for `dchmd
/// ... | head`.
int finish_output(int exit_code);

}  // namespace dch::cli
