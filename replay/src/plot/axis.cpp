// SPDX-License-Identifier: MIT
#include "plot/axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <numeric>

#include "base/number_text.hpp"

namespace dch::cli {
namespace {

double round_step(double span, int wanted) {
  const double raw = span / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

}  // namespace

std::vector<double> round_ticks(double low, double high, int wanted) {
  if (!(high > low)) {
    const double margin = low == 0 ? 1 : 0.1 * std::abs(low);
    high = low + margin;
    low = low - margin;
  }
  const double step = round_step(high - low, wanted);
  const auto first = static_cast<std::int64_t>(std::floor(low / step + 1e-9));
  const auto last = static_cast<std::int64_t>(std::ceil(high / step - 1e-9));
  std::vector<double> ticks;
  for (std::int64_t k = first; k <= last; ++k) ticks.push_back(static_cast<double>(k) * step);
  return ticks;
}

std::string tick_label(double value) {
  const double size = std::abs(value);
  if (size >= 1e6 && size < 1e15) return fmt::format("{:.6g}M", value / 1e6);
  if (size >= 1000 && size < 1e6 && value == std::floor(value))
    return grouped(static_cast<std::int64_t>(value));
  return fmt::format("{:.6g}", value);
}

Grouping::Grouping(std::size_t points, std::size_t limit)
    : size(points), per_group(std::max<std::size_t>(1, (points + limit - 1) / limit)) {}

std::vector<double> Grouping::means(const std::vector<double>& values) const {
  std::vector<double> result;
  for (std::size_t begin = 0; begin < size; begin += per_group) {
    const std::size_t end = std::min(begin + per_group, size);
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = values.begin() + static_cast<std::ptrdiff_t>(end);
    result.push_back(std::accumulate(first, last, 0.0) / static_cast<double>(end - begin));
  }
  return result;
}

}  // namespace dch::cli
