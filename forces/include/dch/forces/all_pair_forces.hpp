// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/forces/lennard_jones.hpp>
#include <dch/lists/exclusions.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Lennard-Jones pairs and charges without a cutoff, in open space: all pairs of particles but excluded ones,
///     4 epsilon ((sigma/r)^12 - (sigma/r)^6) + constant q_i q_j / r
/// with sigma = (sigma_i + sigma_j) / 2 and epsilon = sqrt(epsilon_i epsilon_j).
///
/// Pairs are computed in single precision, by SIMD kernels for the instruction set in use, and summed up in
/// double; distances are exact to rounding wherever the particles are, so forces are off by a few 1e-6 of
/// their size, those of particles that overlap most. Results of one instruction set are the same every time,
/// on any number of threads. Where particles are nearer than about a thousandth of sigma to each other, or at
/// the same place, forces and energy are no numbers.
///
/// One object belongs to one thread at a time. It takes 36 bytes a particle, and 12 for each thread.
class AllPairForces {
 public:
  /// @param charges  of each particle, or empty
  /// @param constant  >= 0 [energy length / charge^2]
  /// @param exclusions  not owned
  /// @throws InvalidParameter for another number of charges, exclusions of another number of particles, a
  ///   negative sigma, epsilon or constant, and what is not finite
  AllPairForces(Span<const LennardJonesParticle> particles, Span<const double> charges, double constant,
                const Exclusions& exclusions);
  ~AllPairForces();
  AllPairForces(AllPairForces&&) noexcept;
  AllPairForces& operator=(AllPairForces&&) noexcept;

  /// Threads to use; null for that of the caller alone. Not owned.
  void set_executor(Executor* executor);

  /// Adds the force on each particle to `forces` [energy/length]. Returns the energy, 0 if that is not
  /// wanted. O(n^2).
  /// @throws InvalidParameter unless there is one position and one force for each particle
  double add_forces(Span<const Vec3> positions, Span<Vec3> forces, bool wants_energy) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch
#pragma GCC visibility pop
