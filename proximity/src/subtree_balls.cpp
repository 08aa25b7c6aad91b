// SPDX-License-Identifier: MIT
#include "subtree_balls.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/metric.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {

SubtreeBalls::SubtreeBalls(const Structure& structure) : levels_(structure.levels.size()) {
  for (int level = 1; level <= structure.top(); ++level) {
    const auto nodes = static_cast<std::size_t>(structure.levels[level].size());
    levels_[level].radius.assign(nodes, 0);
    levels_[level].count.assign(nodes, 0);
  }
  measure_leaves(structure);
  with_metric(structure.box, [&](const auto& metric) {
    for (int level = 2; level <= structure.top(); ++level) measure_level(metric, structure, level);
  });
}

void SubtreeBalls::measure_leaves(const Structure& structure) {
  const MeasuredLeaves& measured = structure.leaves;
  for (std::int32_t k = 0; k < structure.levels[1].size(); ++k) {
    const MeasuredLeaves::Leaf& leaf = measured.leaves[k];
    levels_[1].radius[k] = leaf.extent * kInflate;
    for (std::int32_t b = leaf.first_block; b < leaf.first_block + leaf.blocks; ++b)
      levels_[1].count[k] += measured.count[b];
  }
}

/// While a repair is put off, nodes of the upper levels are where they were before, and so is a singleton,
/// whose point may have moved away from it.
template <class Metric>
void SubtreeBalls::measure_level(const Metric& metric, const Structure& structure, int level) {
  const Level& at = structure.levels[level];
  for (std::int32_t k = 0; k < at.size(); ++k) {
    if (!at.is_alive(k)) continue;
    double radius = 0;
    std::int64_t count = 0;
    if (structure.is_singleton(level, k)) {
      radius = std::sqrt(metric.distance2(at.position[k], metric.wrap(structure.raw[at.id[k]])));
      count = 1;
    }
    structure.for_each_child(level, k, [&](std::int32_t child) {
      const double apart = std::sqrt(metric.distance2(at.position[k], structure.position(level - 1, child)));
      radius = std::max(radius, apart + levels_[level - 1].radius[child]);
      count += levels_[level - 1].count[child];
    });
    levels_[level].radius[k] = radius * kInflate;
    levels_[level].count[k] = count;
  }
}

}  // namespace dch::detail
