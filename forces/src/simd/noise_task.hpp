// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <dch/base/vec3.hpp>

namespace dch::detail {

/// Random numbers of particles at one step.
struct NoiseTask {
  std::uint32_t seed;
  std::uint64_t step;
  const std::int32_t* ids;
  std::size_t count;
  Vec3* noise;  ///< written
};

/// Numbers of Ranmar, the next ones of a sequence.
struct RanmarTask {
  std::int32_t* recent;  ///< the last kRanmarLongLag sums in units of 2^-24, the oldest one first; moved on
  std::int32_t* shift;   ///< that the last sum was less, the same; moved on
  std::size_t count;
  double* numbers;  ///< written, less 1/2
};

struct LangevinTask {
  const double *drag, *strength;
  const Vec3 *velocities, *noise;
  Vec3* forces;  ///< added to
  std::size_t count;
};

struct NoiseKernels {
  void (*uniform)(const NoiseTask& task);
  void (*ranmar)(const RanmarTask& task);
  void (*langevin)(const LangevinTask& task);
};

}  // namespace dch::detail
