// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Philox4x32 with ten rounds (Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC
/// 2011): four random words of 32 bits, which depend on the counter and the key alone. For each key the words
/// run through all values as the counter does.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

/// Random numbers of particles at one step, each uniform in (-1/2, 1/2) in units of 2^-32, of mean 0: (word +
/// 1/2) / 2^32 - 1/2 for the first three words of philox4x32({id, low half of step, high half of step, 0},
/// {seed, 0}). They depend on seed, step and ID alone: not on the order of particles, the instruction set or
/// the number of calls.
/// @throws InvalidParameter if there is not as much room as IDs.
void uniform_noise(std::uint32_t seed, std::int64_t step, Span<const std::int32_t> ids, Span<Vec3> noise);

/// force += drag velocity + strength noise, for each particle. Each product and each sum is rounded on its
/// own, in this order: the same bits on every instruction set.
/// @param drag of each particle, negative where it slows down [mass/time]
/// @param strength of each particle's noise [force]
/// @throws InvalidParameter if there are not as many of all.
void add_langevin_forces(Span<const double> drag, Span<const double> strength, Span<const Vec3> velocities,
                         Span<const Vec3> noise, Span<Vec3> forces);

}  // namespace dch
#pragma GCC visibility pop
