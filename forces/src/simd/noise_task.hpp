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

struct LangevinTask {
  const double *drag, *strength;
  const Vec3 *velocities, *noise;
  Vec3* forces;  ///< added to
  std::size_t count;
};

struct NoiseKernels {
  void (*uniform)(const NoiseTask& task);
  void (*langevin)(const LangevinTask& task);
};

}  // namespace dch::detail
