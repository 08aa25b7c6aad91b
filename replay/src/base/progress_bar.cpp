// SPDX-License-Identifier: MIT
#include "base/progress_bar.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <unistd.h>

#include "base/number_text.hpp"
#include "base/standard_streams.hpp"

namespace dch::cli {

namespace {
constexpr double kSecondsBetweenDrawings = 0.1;
constexpr std::int64_t kBarWidth = 30;
}  // namespace

std::string progress_text(const std::string& action, std::int64_t done, std::int64_t total, double seconds) {
  if (total <= 0) return fmt::format("{} frame {}", action, grouped(done));
  const std::int64_t filled = kBarWidth * std::min(done, total) / total;
  std::string text = fmt::format("{} [{:#<{}}{:.<{}}] {}/{}", action, "", filled, "", kBarWidth - filled,
                                 grouped(done), grouped(total));
  if (done > 0 && seconds > 0) {
    const double per_frame = seconds / static_cast<double>(done);
    text += fmt::format("  {} ms/frame, {:.0f} s left", readable(1e3 * per_frame),
                        per_frame * static_cast<double>(total - std::min(done, total)));
  }
  return text;
}

ProgressBar::ProgressBar(bool quiet) : enabled_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

void ProgressBar::start(const std::string& action, std::int64_t total) {
  action_ = action;
  total_ = total;
  watch_ = Stopwatch();
  last_drawn_ = 0;
}

void ProgressBar::advance(std::int64_t done) {
  const double now = watch_.seconds();
  if (!enabled_ || now - last_drawn_ < kSecondsBetweenDrawings) return;
  last_drawn_ = now;
  drawn_ = true;
  print_message("\r\x1b[K{}", progress_text(action_, done, total_, now));
}

void ProgressBar::clear() {
  if (!drawn_) return;
  drawn_ = false;
  write_message({"\r\x1b[K"});
}

}  // namespace dch::cli
