// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <dch/hierarchy/hierarchy.hpp>

#include "random.hpp"

namespace dch {

/// A hierarchy of side^3 points of density 1, each moved at random from its place in a simple cubic lattice,
/// so that no two are very near: the structure of a liquid, as far as counts of work go.
inline Hierarchy liquid(int side, const Box& box) {
  scenes::Random random(1);
  std::vector<Vec3> points;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) points.push_back(Vec3{x + 0.5, y + 0.5, z + 0.5} + random.in_cube(0.35));
  HierarchyParams params;
  params.radius = 1.5;
  Hierarchy hierarchy(params);
  hierarchy.build(points, box);
  return hierarchy;
}

}  // namespace dch
