// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/tolerance.hpp"
#include "leaves/leaf_source.hpp"

namespace dch::detail {

/// Calls f(leaf) for every node of level 1 that is within `radius` of a point, and some more. A descent:
/// nodes of level i have those of level 1 that are below them within R_1 + ... + R_{i-1}, and twice the
/// motion a level. Returns how many nodes were looked at.
template <class Metric, class F>
std::int64_t for_each_leaf_near(const Metric& metric, const LeafSource& source, Vec3 at, double radius,
                                const F& f) {
  const std::vector<Level>& levels = source.structure->levels;
  std::int64_t visited = 0;
  const auto visit = [&](const auto& self, int level, std::int32_t node, double reach) -> void {
    ++visited;
    if (metric.distance2(at, levels[level].position[node]) > reach * reach) return;
    if (level == 1) {
      f(node);
      return;
    }
    const double below = reach - (levels[level - 1].radius + 2 * source.motion()) * kInflate;
    for (std::int32_t child = levels[level].first_child[node]; child != kNone;
         child = levels[level - 1].next_sibling[child])
      self(self, level - 1, child, below);
  };
  const int top = static_cast<int>(levels.size()) - 1;
  double reach = radius * kInflate;
  for (int level = 1; level < top; ++level) reach += (levels[level].radius + 2 * source.motion()) * kInflate;
  for (std::int32_t root = 0; root < levels[top].size(); ++root)
    if (levels[top].is_alive(root)) visit(visit, top, root, reach);
  return visited;
}

}  // namespace dch::detail
