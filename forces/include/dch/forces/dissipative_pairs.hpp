// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// A pair of types of dissipative particles.
struct DissipativePair {
  double repulsion = 0;  ///< force at no distance [force]
  double friction = 0;   ///< >= 0 [mass/time]
  double cutoff = 0;     ///< >= 0; no force acts if it is 0 [length]
};

struct DissipativeParams {
  int types = 1;
  std::vector<DissipativePair> pairs;  ///< symmetric matrix of pairs of types, row-major
  std::uint32_t seed = 0;
  std::array<double, 4> weight{1, 1, 1, 1};  ///< of each kind of pairs, from 0 to 1; that of the first is 1
};

/// What the forces of a step depend on besides particles.
struct DissipativeStep {
  std::int64_t number = 0;    ///< that random numbers depend on
  double thermal_energy = 0;  ///< k T, >= 0 [force length]
  double duration = 1;        ///< > 0 [time]
};

/// Pairs of particles, and what they add. Those beyond `count` hold any numbers.
struct alignas(64) DissipativeBatch {
  static constexpr int kSize = 64;
  double x[kSize]{}, y[kSize]{}, z[kSize]{};     ///< from the second to the first particle [length]
  double vx[kSize]{}, vy[kSize]{}, vz[kSize]{};  ///< of the first relative to the second [length/time]
  std::int32_t first_id[kSize]{}, second_id[kSize]{};
  std::int32_t types[kSize]{};   ///< where the pair of types stands in the matrix
  std::int32_t kind[kSize]{};    ///< 0 to 3
  double force_over_r[kSize]{};  ///< of the first particle, along x, y, z; written
  double energy[kSize]{};        ///< of the repulsion; written
  int count = 0;                 ///< 0 to kSize
};

/// Forces of dissipative particle dynamics (Groot and Warren, J. Chem. Phys. 107, 4423 (1997)) along the line
/// between two particles at the distance r < c: with w = 1 - r/c
///
///     a w - friction w^2 (e . v) + sqrt(2 friction k T / dt) w n
///
/// and the energy a c w^2 / 2. n is a random number of mean 0 and variance 1, uniform as in that paper:
/// sqrt(12) ((word + 1/2) / 2^32 - 1/2) for the first word of philox4x32({smaller ID, larger ID, low half of
/// the step's number, high half}, {seed, 1}). It depends on seed, step and IDs alone, and is the same for
/// both particles. A weight multiplies energy, repulsion and friction, its root the random force, so that
/// fluctuation and dissipation stay in balance. Pairs nearer than 1e-10 have no force.
class DissipativePairs {
 public:
  /// @throws InvalidParameter for numbers that are not finite, an asymmetric matrix, negative friction or
  ///   cutoffs, and weights that are not between 0 and 1 or do not begin with 1.
  explicit DissipativePairs(const DissipativeParams& params);

  /// Types and kinds of pairs are not checked.
  /// @throws InvalidParameter for a negative thermal energy, a duration of 0 or less, and a count that is
  ///   negative or more than kSize.
  void compute(const DissipativeStep& step, DissipativeBatch& batch) const;

 private:
  int types_;
  std::uint32_t seed_;
  /// By kind and pair of types: repulsion, friction, noise at k T / dt of 1, 1/cutoff, energy at no distance.
  std::array<std::vector<double>, 5> table_;
};

}  // namespace dch
#pragma GCC visibility pop
