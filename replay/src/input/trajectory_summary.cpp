// SPDX-License-Identifier: MIT
#include "input/trajectory_summary.hpp"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/number_text.hpp"

namespace dch::cli {

std::string unit_suffix(const std::string& unit) {
  return unit.find(' ') == std::string::npos ? unit : "[" + unit + "]";
}

std::string box_text(const TrajectorySummary& summary) {
  std::string text = fmt::format("{}", fmt::join(summary.box_kinds, "; "));
  if (std::isfinite(summary.smallest_height)) {
    text += fmt::format(", smallest height {} {} (frame {})", readable(summary.smallest_height),
                        unit_suffix(summary.unit), summary.smallest_height_frame);
  }
  return text;
}

}  // namespace dch::cli
