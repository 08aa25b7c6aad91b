// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "contact_oracle.hpp"

namespace dch::test {

/// A pair of particles and the gap between their surfaces.
struct Closest {
  std::int32_t i = -1, j = -1;  ///< -1 if there is no pair
  double gap = std::numeric_limits<double>::infinity();
};

/// The closest pair that is farther apart along its chain than skip_bonds, by looking at all pairs.
inline Closest closest_oracle(const necklace::Necklace& necklace, const std::vector<Vec3>& positions,
                              int skip_bonds) {
  // Every pair that counts is a contact if the gap is large enough.
  const auto pairs = contact_oracle(necklace, positions, Box::none(), {1e150, skip_bonds, true, true});
  Closest closest;
  for (const auto& [i, j] : pairs) {
    const Vec3 d = positions[static_cast<std::size_t>(j)] - positions[static_cast<std::size_t>(i)];
    const double gap = std::sqrt(norm2(d)) - necklace.radius(i) - necklace.radius(j);
    if (gap < closest.gap) closest = {i, j, gap};
  }
  return closest;
}

}  // namespace dch::test
