// SPDX-License-Identifier: MIT
//
// Forces of harmonic bonds equal those of a plain loop.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/forces/harmonic_bonds.hpp>

#include "instruction_sets.hpp"
#include "lj_oracle.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

std::vector<Vec3> plain_forces(const std::vector<BondOfType>& bonds, int first_type,
                               const std::vector<HarmonicBond>& types, const std::vector<Vec3>& positions,
                               std::array<double, 6>& virial) {
  std::vector<Vec3> force(positions.size());
  for (const BondOfType& bond : bonds) {
    const HarmonicBond& type = types[static_cast<std::size_t>(bond.type - first_type)];
    const auto i = static_cast<std::size_t>(bond.i), j = static_cast<std::size_t>(bond.j);
    const Vec3 d = positions[j] - positions[i];
    const double r = std::sqrt(norm2(d));
    if (r == 0) continue;
    const double over_r = -2 * type.k * (r - type.r0) / r;
    force[j] = force[j] + over_r * d;
    force[i] = force[i] - over_r * d;
    const double products[] = {d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z};
    for (std::size_t k = 0; k < 6; ++k) virial[k] += over_r * products[k];
  }
  return force;
}

TEST(HarmonicTest, EqualsAPlainLoop) {
  const RestoreInstructionSet restore;
  for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 500u})
    for (const std::size_t type_count : {1u, 3u}) {
      std::vector<HarmonicBond> types;
      for (std::size_t k = 0; k < type_count; ++k)
        types.push_back({30.0 + static_cast<double>(k), 0.9 + 0.05 * static_cast<double>(k)});
      scenes::Random random(5);
      std::vector<Vec3> positions(1);
      std::vector<BondOfType> bonds;
      for (std::size_t k = 0; k < count; ++k) {
        const bool has_no_length = k % 50 == 3;
        positions.push_back(has_no_length ? positions.back() : positions.back() + random.in_ball(1.5));
        const auto here = static_cast<std::int32_t>(k);
        bonds.push_back({here, here + 1, 1 + static_cast<std::int32_t>(k % type_count)});
      }
      std::array<double, 6> expected_virial{};
      const std::vector<Vec3> expected = plain_forces(bonds, 1, types, positions, expected_virial);
      double scale = 1;
      for (const double v : expected_virial) scale = std::max(scale, std::abs(v));
      const HarmonicForces harmonic(types);
      for (const InstructionSet set : supported_sets()) {
        set_instruction_set(set);
        std::vector<Vec3> forces(positions.size()), again(positions.size());
        harmonic.add_forces(bonds, 1, positions, forces);
        EXPECT_LT(force_error(forces, expected), 1e-14) << name(set) << ' ' << count << ' ' << type_count;
        std::array<double, 6> virial{1, 1, 1, 1, 1, 1};
        harmonic.add_forces(bonds, 1, positions, again, &virial);
        EXPECT_EQ(again, forces) << name(set);
        for (std::size_t k = 0; k < 6; ++k)
          EXPECT_NEAR(virial[k], expected_virial[k] + 1, 1e-13 * scale)
              << name(set) << ' ' << count << ' ' << k;
      }
    }
}

TEST(HarmonicTest, RefusesWhatDoesNotFit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(HarmonicForces({{nan, 1}}), InvalidParameter);
  EXPECT_THROW(HarmonicForces({{30, 1}, {30, nan}}), InvalidParameter);
  const std::vector<Vec3> positions(2);
  std::vector<Vec3> forces(1);
  EXPECT_THROW(HarmonicForces({{30, 1}}).add_forces({}, 1, positions, forces), InvalidParameter);
}

}  // namespace
}  // namespace dch
