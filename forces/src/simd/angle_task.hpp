// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/vec3.hpp>
#include <dch/forces/angles.hpp>

namespace dch::detail {

/// Angles, and coefficients by type.
struct AngleTask {
  const AngleOfType* angles;
  std::int64_t count;
  std::int32_t first_type, types;
  const double* table[2];
  const Vec3* positions;
  Vec3* forces;    ///< added to
  double* virial;  ///< six sums of d f, added to; null if not wanted
};

/// Each adds the forces of all angles.
struct AngleKernels {
  void (*harmonic)(const AngleTask& task);
  void (*cosine)(const AngleTask& task);
};

}  // namespace dch::detail
