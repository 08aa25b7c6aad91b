// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <dch/base/vec3.hpp>

namespace dch::detail {

/// Particles, each with its own dt/mass.
struct MotionTask {
  const double* dt_over_mass;
  double dt;  ///< of positions
  const Vec3* forces;
  Vec3* velocities;
  Vec3* positions;  ///< null for a kick alone
  std::size_t count;
};

struct MotionKernels {
  void (*kick)(const MotionTask& task);
  void (*kick_and_drift)(const MotionTask& task);
};

}  // namespace dch::detail
