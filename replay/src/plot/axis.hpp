// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace dch::cli {

/// Round numbers (1, 2 or 5 times a power of ten apart) from at or below `low` to at or above `high`.
/// @param wanted about how many intervals; > 0
std::vector<double> round_ticks(double low, double high, int wanted);

/// Short label of a tick: 0.05, 2.5, 12,000, 3M, 1e-07.
std::string tick_label(double value);

/// Points in order merged into at most `limit` groups of neighbors, so that long runs can be drawn.
struct Grouping {
  std::size_t size = 0;       ///< number of points
  std::size_t per_group = 1;  ///< points in each group; the last one may hold fewer

  Grouping(std::size_t points, std::size_t limit);
  std::size_t groups() const { return (size + per_group - 1) / per_group; }
  /// Mean of each group.
  std::vector<double> means(const std::vector<double>& values) const;
};

}  // namespace dch::cli
