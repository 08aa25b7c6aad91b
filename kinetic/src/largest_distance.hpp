// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include <dch/kinetic/kinetic_edges.hpp>

namespace dch::kinetic {

inline double largest_distance(const KineticParams& params) {
  return params.radii.empty() ? params.cutoff
                              : 2 * *std::max_element(params.radii.begin(), params.radii.end());
}

}  // namespace dch::kinetic
