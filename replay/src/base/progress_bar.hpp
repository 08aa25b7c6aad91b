// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "base/stopwatch.hpp"

namespace dch::cli {

/// A live line on standard error, drawn at most ten times a second, and only if that is a terminal.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Starts anew. @param total number of frames to come; 0 if it is not known
  void start(const std::string& action, std::int64_t total = 0);
  void advance(std::int64_t done);
  void clear();

 private:
  bool enabled_;
  bool drawn_ = false;
  std::string action_;
  std::int64_t total_ = 0;
  double last_drawn_ = 0;  ///< in seconds of watch_
  Stopwatch watch_;
};

/// The line without control characters; shown by the bar and checked by tests.
std::string progress_text(const std::string& action, std::int64_t done, std::int64_t total, double seconds);

}  // namespace dch::cli
