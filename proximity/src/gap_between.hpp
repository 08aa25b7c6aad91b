// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <dch/proximity/point_tree.hpp>

#include "geometry/tolerance.hpp"

namespace dch::detail {

/// No point below one node is nearer to one below the other [length].
inline double gap_between(const PointTree& tree, const PointTree::Node& a, const PointTree::Node& b) {
  const double apart = std::sqrt(tree.box().distance2(a.center, b.center)) / kInflate;
  return std::max(0.0, apart - a.radius - b.radius - tree.rounding());
}

}  // namespace dch::detail
