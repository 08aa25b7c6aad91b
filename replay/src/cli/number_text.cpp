// SPDX-License-Identifier: MIT
#include "number_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace dch::cli {

std::string grouped(std::int64_t value) {
  std::string text = fmt::format("{}", value);
  const std::size_t digits_begin = text.front() == '-' ? 1 : 0;
  for (std::size_t end = text.size(); end > digits_begin + 3; end -= 3) text.insert(end - 3, ",");
  return text;
}

std::string readable(double value) {
  const double size = std::abs(value);
  if (!std::isfinite(value) || (size > 0 && size < 1e-3) || size >= 1e15) return fmt::format("{:.4g}", value);
  if (size >= 1000) return grouped(std::llround(value));
  return fmt::format("{:.4g}", value);
}

}  // namespace dch::cli
