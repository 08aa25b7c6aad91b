// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <dch/zonotope/zonotope.hpp>

#include "random.hpp"

namespace dch::zonotope {

/// A center within `reach` of the origin along each axis, and generators in the cube.
inline Zonotope random_zonotope(scenes::Random& random, std::size_t count, double reach = 1) {
  Zonotope z{random.in_cube(reach), {}};
  for (std::size_t k = 0; k < count; ++k) z.generators.push_back(random.in_cube(1));
  return z;
}

inline Zonotope random_zonotope(std::size_t count, std::uint64_t seed) {
  scenes::Random random(seed);
  return random_zonotope(random, count);
}

}  // namespace dch::zonotope
