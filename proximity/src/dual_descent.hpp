// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <dch/proximity/point_tree.hpp>

namespace dch::detail {

/// Pairs of nodes of a tree that cover each pair of its points once: the children of every node with each
/// other, and where is_separated(a, b) does not hold, the children of the one with the larger ball with the
/// other. Calls f(a, b) for those for which it holds, which it must for two balls of radius 0. Returns for
/// how many pairs it was asked.
template <class Separated, class F>
std::int64_t for_each_separated_pair(const PointTree& tree, const Separated& is_separated, const F& f) {
  std::int64_t asked = 0;
  std::vector<std::pair<std::int32_t, std::int32_t>> waiting;
  for (const PointTree::Node& parent : tree.nodes()) {
    const std::int32_t end = parent.first_child + parent.children;
    for (std::int32_t a = parent.first_child; a < end; ++a)
      for (std::int32_t b = a + 1; b < end; ++b) waiting.emplace_back(a, b);
    while (!waiting.empty()) {
      auto [a, b] = waiting.back();
      waiting.pop_back();
      ++asked;
      if (is_separated(tree.node(a), tree.node(b))) {
        f(a, b);
        continue;
      }
      if (tree.node(a).radius < tree.node(b).radius) std::swap(a, b);
      const PointTree::Node& larger = tree.node(a);
      for (std::int32_t k = 0; k < larger.children; ++k) waiting.emplace_back(larger.first_child + k, b);
    }
  }
  return asked;
}

}  // namespace dch::detail
