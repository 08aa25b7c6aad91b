// SPDX-License-Identifier: MIT
//
// The background that takes a net charge away, which versions of OpenMM count from 8.3 on.
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include <dch/forces/ewald_mesh.hpp>

#include "PairPotential.h"
#include "ReciprocalSum.h"

namespace OpenMMDCH {
namespace {

TEST(BackgroundTest, IsCountedAsByOpenMM) {
  for (const char* const version : {"7.7", "8.0", "8.1.2", "8.2.0", "8"})
    EXPECT_FALSE(countsBackground(version)) << version;
  for (const char* const version : {"8.3", "8.3.1", "8.5.2", "8.10", "9.0", "10.1"})
    EXPECT_TRUE(countsBackground(version)) << version;
}

/// With it the energy of charges does not depend on how their sum is split.
TEST(BackgroundTest, MakesUpForTheSplitting) {
  const double side = 2, constant = PairPotential::coulombConstant();
  const std::vector<dch::Vec3> positions{{0, 0, 0}, {0.3, 0.4, 0}};
  const std::vector<double> charges{1.1, 2};
  const dch::Box box = dch::Box::orthorhombic({side, side, side});
  const auto energy = [&](double splitting) {
    std::vector<dch::Vec3> forces(2);
    dch::EwaldMesh mesh({80, 80, 80}, splitting, constant);
    double sum = mesh.add_forces(positions, charges, box, forces);
    for (const double q : charges) sum -= constant * splitting / std::sqrt(std::acos(-1.0)) * q * q;
    for (int n = 0; n < 125; ++n) {
      const dch::Vec3 image = side * dch::Vec3{n % 5 - 2.0, n / 5 % 5 - 2.0, n / 25 - 2.0};
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) {
          const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
          const double r = std::sqrt(norm2(positions[j] - positions[i] + image));
          if (r > 0) sum += constant / 2 * charges[i] * charges[j] * std::erfc(splitting * r) / r;
        }
    }
    return sum;
  };
  const double first = energy(2.5), second = energy(4.5);
  EXPECT_GT(std::abs(first - second), 10);
  EXPECT_NEAR(first + energyOfBackground(3.1, 2.5, 8), second + energyOfBackground(3.1, 4.5, 8), 1e-3);
}

}  // namespace
}  // namespace OpenMMDCH
