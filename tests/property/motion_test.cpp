// SPDX-License-Identifier: MIT
//
// Steps of motion have the bits of a plain loop, on every instruction set.
#include <gtest/gtest.h>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/forces/motion.hpp>

#include "instruction_sets.hpp"
#include "random.hpp"

namespace dch {
namespace {

struct Particles {
  std::vector<double> dt_over_mass;
  std::vector<Vec3> forces, velocities, positions;
};

Particles random_particles(std::size_t count) {
  scenes::Random random(17);
  Particles made;
  for (std::size_t i = 0; i < count; ++i) {
    made.dt_over_mass.push_back(random.uniform(1e-3, 1e-2));
    made.forces.push_back(random.in_cube(100));
    made.velocities.push_back(random.in_cube(3));
    made.positions.push_back(random.in_cube(50));
  }
  return made;
}

Vec3 moved(const Vec3& at, double by, const Vec3& along) {
  // Rounded before they are added, whatever the compiler fuses.
  const volatile double x = by * along.x, y = by * along.y, z = by * along.z;
  return {at.x + x, at.y + y, at.z + z};
}

TEST(MotionTest, HasTheBitsOfAPlainLoop) {
  constexpr double kStep = 0.0123;
  const RestoreInstructionSet restore;
  for (const std::size_t count : {0u, 1u, 2u, 3u, 7u, 8u, 9u, 64u, 333u}) {
    const Particles before = random_particles(count);
    Particles expected = before;
    for (std::size_t i = 0; i < count; ++i) {
      expected.velocities[i] = moved(before.velocities[i], before.dt_over_mass[i], before.forces[i]);
      expected.positions[i] = moved(before.positions[i], kStep, expected.velocities[i]);
    }
    for (const InstructionSet set : supported_sets()) {
      set_instruction_set(set);
      Particles kicked = before, both = before;
      kick(kicked.dt_over_mass, kicked.forces, kicked.velocities);
      kick_and_drift(both.dt_over_mass, kStep, both.forces, both.velocities, both.positions);
      EXPECT_EQ(kicked.velocities, expected.velocities) << set << ' ' << count;
      EXPECT_EQ(both.velocities, expected.velocities) << set << ' ' << count;
      EXPECT_EQ(both.positions, expected.positions) << set << ' ' << count;
    }
  }
}

TEST(MotionTest, RefusesWhatDoesNotFit) {
  Particles some = random_particles(3);
  std::vector<Vec3> fewer(2);
  EXPECT_THROW(kick(some.dt_over_mass, some.forces, fewer), InvalidParameter);
  EXPECT_THROW(kick(some.dt_over_mass, fewer, some.velocities), InvalidParameter);
  EXPECT_THROW(kick_and_drift(some.dt_over_mass, 1, some.forces, some.velocities, fewer), InvalidParameter);
  EXPECT_THROW(kick_and_drift(some.dt_over_mass, 1, fewer, some.velocities, some.positions),
               InvalidParameter);
}

}  // namespace
}  // namespace dch
