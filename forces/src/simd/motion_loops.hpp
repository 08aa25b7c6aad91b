// SPDX-License-Identifier: MIT
//
// Steps of motion: plain loops, of which the compiler makes vectors of each instruction set. No product is
// fused with a sum (-ffp-contract=off), so the bits are those of a plain loop.
#pragma once

#include "simd/motion_task.hpp"

namespace dch::detail {
namespace {

inline void motion_kick(const MotionTask& task) {
  const double* const __restrict over_mass = task.dt_over_mass;
  const double* const __restrict force = &task.forces->x;
  double* const __restrict velocity = &task.velocities->x;
  for (std::size_t i = 0; i < task.count; ++i)
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) velocity[k] += over_mass[i] * force[k];
}

inline void motion_kick_and_drift(const MotionTask& task) {
  const double* const __restrict over_mass = task.dt_over_mass;
  const double* const __restrict force = &task.forces->x;
  double* const __restrict velocity = &task.velocities->x;
  double* const __restrict position = &task.positions->x;
  for (std::size_t i = 0; i < task.count; ++i)
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      velocity[k] += over_mass[i] * force[k];
      position[k] += task.dt * velocity[k];
    }
}

inline constexpr MotionKernels motion_kernels{motion_kick, motion_kick_and_drift};

}  // namespace
}  // namespace dch::detail
