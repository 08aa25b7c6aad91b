// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hierarchy/structure.hpp"

namespace dch::detail {

/// The implicit balls of a hierarchy as they are: for each node of level 1 and above the radius of a ball
/// around it that holds the points below it, and how many they are.
class SubtreeBalls {
 public:
  explicit SubtreeBalls(const Structure& structure);

  double radius(int level, std::int32_t node) const { return levels_[level].radius[node]; }
  std::int64_t count(int level, std::int32_t node) const { return levels_[level].count[node]; }

 private:
  struct Balls {
    std::vector<double> radius;       ///< by node [length]
    std::vector<std::int64_t> count;  ///< by node
  };
  void measure_leaves(const Structure& structure);
  template <class Metric>
  void measure_level(const Metric& metric, const Structure& structure, int level);

  std::vector<Balls> levels_;
};

}  // namespace dch::detail
