// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// The part of an Ewald sum of charges in reciprocal space, wave by wave (Ewald, Ann. Phys. 369:253, 1921),
/// in a rectangular box: for few charges, or where a mesh would not be exact enough (see EwaldMesh).
///
/// The energy is that of each pair and all its images, constant q_i q_j erf(splitting r) / r, and of each
/// charge with itself, constant splitting / sqrt(pi) q_i^2, which a caller takes away; what waves of higher
/// numbers hold of it is missing. All is in double: forces and energy are off by a few 1e-14 of the sums of
/// the absolute values. They have the same bits on any number of threads.
///
/// One object belongs to one thread at a time. It takes 192 bytes a wave (of those with numbers not
/// negative), and 512 more for each thread.
class EwaldWaves {
 public:
  /// @param count  of wave numbers along the axes, 1 to 1,000: 0 .. count - 1, and their negatives
  /// @param splitting  > 0 [1/length]
  /// @param constant  >= 0 [energy length / charge^2]
  /// @throws InvalidParameter for numbers outside of these
  EwaldWaves(std::array<int, 3> count, double splitting, double constant);
  ~EwaldWaves();
  EwaldWaves(EwaldWaves&&) noexcept;
  EwaldWaves& operator=(EwaldWaves&&) noexcept;

  /// Threads to use; null for that of the caller alone. Not owned.
  void set_executor(Executor* executor);

  /// Adds the force on each charge to `forces` [energy/length] and returns the energy. O(n w) for n charges
  /// and w waves.
  /// @param positions  in any image [length]
  /// @throws InvalidParameter unless there is one charge and one force for each position; InvalidBox unless
  ///   the box is rectangular and periodic along all axes; InvalidPosition for one that is not finite
  double add_forces(Span<const Vec3> positions, Span<const double> charges, const Box& box,
                    Span<Vec3> forces);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch
#pragma GCC visibility pop
