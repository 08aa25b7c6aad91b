// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include <dch/vec3.hpp>

namespace dch::detail {

/// Vectors g with g[i] . v[j] = delta_ij in the span of the first `rank` vectors of v; the others are zero.
inline std::array<Vec3, 3> dual_basis(const std::array<Vec3, 3>& v, int rank) {
  std::array<Vec3, 3> dual{};
  if (rank == 1) {
    dual[0] = (1 / norm2(v[0])) * v[0];
  } else if (rank == 2) {
    const Vec3 normal = cross(v[0], v[1]);
    const double scale = 1 / norm2(normal);
    dual[0] = scale * cross(v[1], normal);
    dual[1] = scale * cross(normal, v[0]);
  } else if (rank == 3) {
    const double scale = 1 / dot(v[0], cross(v[1], v[2]));
    dual[0] = scale * cross(v[1], v[2]);
    dual[1] = scale * cross(v[2], v[0]);
    dual[2] = scale * cross(v[0], v[1]);
  }
  return dual;
}

}  // namespace dch::detail
