// SPDX-License-Identifier: MIT
#include "base/number_text.hpp"

#include <cmath>
#include <fmt/format.h>

namespace dch::cli {

std::string grouped(std::int64_t value) {
  const std::string digits = fmt::format("{}", value);
  const std::size_t sign = digits.front() == '-' ? 1 : 0;
  std::string text;
  for (std::size_t k = 0; k < digits.size(); ++k) {
    if (k > sign && (digits.size() - k) % 3 == 0) text += ',';
    text += digits[k];
  }
  return text;
}

std::string counted(std::int64_t number, const std::string& thing) {
  return grouped(number) + " " + thing + (number == 1 ? "" : "s");
}

std::string count_text(std::int64_t fewest, std::int64_t most) {
  return fewest == most ? grouped(most) : grouped(fewest) + " to " + grouped(most);
}

std::string readable(double value) {
  const double size = std::abs(value);
  if (!std::isfinite(value) || (size > 0 && size < 1e-3) || size >= 1e15) return fmt::format("{:.4g}", value);
  if (size >= 1000) return grouped(std::llround(value));
  return fmt::format("{:.4g}", value);
}

}  // namespace dch::cli
