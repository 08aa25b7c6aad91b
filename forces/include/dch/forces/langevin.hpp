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

/// Random numbers of Ranmar, the generator of Marsaglia, Zaman and Tsang ("Toward a universal random number
/// generator", Statistics and Probability Letters 9, 1990) with the seeds of James ("A review of pseudorandom
/// number generators", Computer Physics Communications 60, 1990): one after another of a sequence, of period
/// 2^144, as LAMMPS draws them, many at once.
class RanmarNoise {
 public:
  /// LAMMPS's seeds: one number has been drawn already.
  /// @throws InvalidParameter unless the seed is from 1 to 900,000,000
  explicit RanmarNoise(int seed);

  /// The next three numbers for each vector, uniform in [-1/2, 1/2) in units of 2^-24. They do not depend on
  /// the number of calls nor on the instruction set.
  void draw(Span<Vec3> noise);

 private:
  std::array<std::int32_t, 97> recent_{};  ///< sums in units of 2^-24, the oldest one first
  std::int32_t shift_;
};

/// force += drag velocity + strength noise, for each particle. Each product and each sum is rounded on its
/// own, in this order: the same bits on every instruction set.
/// @param drag of each particle, negative where it slows down [mass/time]
/// @param strength of each particle's noise [force]
/// @throws InvalidParameter if there are not as many of all.
void add_langevin_forces(Span<const double> drag, Span<const double> strength, Span<const Vec3> velocities,
                         Span<const Vec3> noise, Span<Vec3> forces);

}  // namespace dch
#pragma GCC visibility pop
