// SPDX-License-Identifier: GPL-2.0-or-later
#include "ghosts_left_out.h"

#include <gtest/gtest.h>
#include <random>
#include <set>
#include <vector>

namespace LAMMPS_NS {
namespace {

/// Places in a box that is `extent` wide along each axis.
struct Ghosts {
  std::vector<double> coordinates;
  std::vector<double*> x;
  std::vector<int> indices;

  Ghosts(int count, dch::Vec3 extent, std::mt19937& draw) {
    std::uniform_real_distribution<double> unit(0, 1);
    for (int k = 0; k < count; ++k)
      for (int axis = 0; axis < 3; ++axis) coordinates.push_back(extent[axis] * unit(draw));
    for (std::size_t k = 0; k < coordinates.size(); k += 3) x.push_back(&coordinates[k]);
    for (int k = 0; k < count; k += 2) indices.push_back(k);  // the others are points
  }
};

TEST(GhostsLeftOut, AreFoundWithinTheRadiusAndNoOthers) {
  std::mt19937 draw(5);
  std::uniform_real_distribution<double> unit(-0.2, 1.2);
  const std::vector<dch::Vec3> extents{{9, 2, 3}, {1, 9, 2}, {2, 1, 9}, {5, 5, 5}, {0, 0, 0}};
  for (const dch::Vec3 extent : extents) {
    const Ghosts all(500, extent, draw);
    const GhostsLeftOut ghosts(3, all.indices, all.x.data());
    EXPECT_EQ(ghosts.type(), 3);
    for (const double radius : {0.0, 0.1, 0.7, 3.0, 20.0}) {
      const dch::Vec3 place{extent.x * unit(draw), extent.y * unit(draw), extent.z * unit(draw)};
      std::set<int> expected, found;
      for (const int k : all.indices) {
        const double* const at = all.x[static_cast<std::size_t>(k)];
        if (norm2(dch::Vec3{at[0], at[1], at[2]} - place) <= radius * radius) expected.insert(k);
      }
      const bool any = ghosts.any_near(place, radius, [&](int k, dch::Vec3 before) {
        EXPECT_EQ(before.x, all.x[static_cast<std::size_t>(k)][0]);
        found.insert(k);
        return false;
      });
      EXPECT_FALSE(any);
      EXPECT_EQ(found, expected);
      EXPECT_EQ(ghosts.any_near(place, radius, [](int, dch::Vec3) { return true; }), !expected.empty());
    }
  }
}

}  // namespace
}  // namespace LAMMPS_NS
