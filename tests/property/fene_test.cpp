// SPDX-License-Identifier: MIT
//
// FENE forces equal those of a plain loop.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/forces/fene.hpp>

#include "instruction_sets.hpp"
#include "lj_oracle.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

std::vector<Vec3> plain_forces(const std::vector<BondOfType>& bonds, int first_type,
                               const std::vector<FeneBond>& types, const std::vector<Vec3>& positions,
                               std::array<double, 6>& virial) {
  std::vector<Vec3> force(positions.size());
  for (const BondOfType& bond : bonds) {
    const FeneBond& type = types[static_cast<std::size_t>(bond.type - first_type)];
    const auto i = static_cast<std::size_t>(bond.i), j = static_cast<std::size_t>(bond.j);
    const Vec3 d = positions[j] - positions[i];
    const double r2 = norm2(d), left = 1 - r2 / (type.r0 * type.r0);
    if (left < 0.1) continue;
    double over_r = -type.k / left;
    if (r2 < std::cbrt(2.0) * type.sigma * type.sigma) {
      const double s6 = std::pow(type.sigma * type.sigma / r2, 3);
      over_r += 48 * type.epsilon * s6 * (s6 - 0.5) / r2;
    }
    force[j] = force[j] + over_r * d;
    force[i] = force[i] - over_r * d;
    const double products[] = {d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z};
    for (std::size_t k = 0; k < 6; ++k) virial[k] += over_r * products[k];
  }
  return force;
}

TEST(FeneTest, EqualsAPlainLoop) {
  const RestoreInstructionSet restore;
  for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 500u})
    for (const std::size_t type_count : {1u, 3u}) {
      std::vector<FeneBond> types;
      for (std::size_t k = 0; k < type_count; ++k)
        types.push_back({30.0 + static_cast<double>(k), 1.5, 1.1, 1.0 + 0.02 * static_cast<double>(k)});
      scenes::Random random(5);
      std::vector<Vec3> positions(1);
      std::vector<BondOfType> bonds;
      std::vector<std::int32_t> expected_too_long;
      for (std::size_t k = 0; k < count; ++k) {
        const Vec3 direction = random.in_ball(1);
        const bool is_long = k % 50 == 3;
        const double length = is_long ? 1.45 : 0.85 + 0.4 * random.uniform();
        positions.push_back(positions.back() + length / std::sqrt(norm2(direction)) * direction);
        const auto here = static_cast<std::int32_t>(k);
        bonds.push_back({here, here + 1, 1 + static_cast<std::int32_t>(k % type_count)});
        if (is_long) expected_too_long.push_back(here);
      }
      std::array<double, 6> expected_virial{};
      const std::vector<Vec3> expected = plain_forces(bonds, 1, types, positions, expected_virial);
      double scale = 1;
      for (const double v : expected_virial) scale = std::max(scale, std::abs(v));
      const FeneForces fene(types);
      for (const InstructionSet set : supported_sets()) {
        set_instruction_set(set);
        std::vector<Vec3> forces(positions.size());
        std::vector<std::int32_t> too_long{77};
        fene.add_forces(bonds, 1, positions, forces, too_long);
        EXPECT_EQ(too_long, expected_too_long) << name(set);
        EXPECT_LT(force_error(forces, expected), 1e-14) << name(set) << ' ' << count << ' ' << type_count;
        std::vector<Vec3> again(positions.size());
        std::array<double, 6> virial{1, 1, 1, 1, 1, 1};
        fene.add_forces(bonds, 1, positions, again, too_long, &virial);
        EXPECT_EQ(again, forces) << name(set);
        for (std::size_t k = 0; k < 6; ++k)
          EXPECT_NEAR(virial[k], expected_virial[k] + 1, 1e-13 * scale)
              << name(set) << ' ' << count << ' ' << k;
      }
    }
}

TEST(FeneTest, RefusesWhatDoesNotFit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(FeneForces({{nan, 1.5, 1, 1}}), InvalidParameter);
  EXPECT_THROW(FeneForces({{30, 0, 1, 1}}), InvalidParameter);
  EXPECT_THROW(FeneForces({{30, 1.5, 1, 1}, {30, 1.5, 1, -1}}), InvalidParameter);
  const FeneForces fene({{30, 1.5, 1, 1}});
  const std::vector<Vec3> positions(2);
  std::vector<Vec3> forces(1);
  std::vector<std::int32_t> too_long;
  EXPECT_THROW(fene.add_forces({}, 1, positions, forces, too_long), InvalidParameter);
}

}  // namespace
}  // namespace dch
