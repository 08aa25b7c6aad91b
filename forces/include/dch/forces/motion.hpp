// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// The steps of velocity Verlet. Each product and each sum is rounded on its own, in the order of the
/// formula: the bits are the same on every instruction set, and those of a plain loop without fused
/// operations.
///
/// velocity += dt_over_mass force, for each particle.
/// @throws InvalidParameter if there are not as many numbers, forces and velocities.
void kick(Span<const double> dt_over_mass, Span<const Vec3> forces, Span<Vec3> velocities);

/// velocity += dt_over_mass force, then position += dt velocity.
/// @throws InvalidParameter if there are not as many numbers, forces, velocities and positions.
void kick_and_drift(Span<const double> dt_over_mass, double dt, Span<const Vec3> forces,
                    Span<Vec3> velocities, Span<Vec3> positions);

}  // namespace dch
#pragma GCC visibility pop
