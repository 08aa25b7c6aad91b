// SPDX-License-Identifier: MIT
#include <dch/base/instruction_set.hpp>
#include <dch/forces/motion.hpp>

#include "same_count.hpp"
#include "simd/force_kernels.hpp"

namespace dch {

void kick(Span<const double> dt_over_mass, Span<const Vec3> forces, Span<Vec3> velocities) {
  detail::require_same_count(velocities.size(), "velocities", dt_over_mass.size(), "numbers dt/mass");
  detail::require_same_count(velocities.size(), "velocities", forces.size(), "forces");
  if (velocities.empty()) return;
  detail::force_kernels(instruction_set())
      .motion.kick({dt_over_mass.data(), 0, forces.data(), velocities.data(), nullptr, velocities.size()});
}

void kick_and_drift(Span<const double> dt_over_mass, double dt, Span<const Vec3> forces,
                    Span<Vec3> velocities, Span<Vec3> positions) {
  detail::require_same_count(velocities.size(), "velocities", dt_over_mass.size(), "numbers dt/mass");
  detail::require_same_count(velocities.size(), "velocities", forces.size(), "forces");
  detail::require_same_count(velocities.size(), "velocities", positions.size(), "positions");
  if (velocities.empty()) return;
  detail::force_kernels(instruction_set())
      .motion.kick_and_drift(
          {dt_over_mass.data(), dt, forces.data(), velocities.data(), positions.data(), velocities.size()});
}

}  // namespace dch
