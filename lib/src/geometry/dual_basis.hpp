// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <dch/base/vec3.hpp>

namespace dch::detail {

inline double norm(Vec3 v) { return std::sqrt(norm2(v)); }

/// Vectors g with g[i] . v[j] = delta_ij in the span of the first `rank` vectors of v; the others are zero.
/// The vectors are brought to a length of about 1 by powers of two, which is exact, since products of four of
/// theirs would leave double precision from lengths of 1e77 on.
inline std::array<Vec3, 3> dual_basis(const std::array<Vec3, 3>& given, int rank) {
  std::array<Vec3, 3> v{}, dual{};
  std::array<double, 3> scale{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(rank); ++k) {
    int exponent = 0;  // stays so for a vector that is 0 or not finite, which a box is refused for
    std::frexp(norm(given[k]), &exponent);
    scale[k] = std::ldexp(1, 1 - exponent);
    v[k] = scale[k] * given[k];
  }
  if (rank == 1) {
    dual[0] = (1 / norm2(v[0])) * v[0];
  } else if (rank == 2) {
    const Vec3 normal = cross(v[0], v[1]);
    const double inverse = 1 / norm2(normal);
    dual[0] = inverse * cross(v[1], normal);
    dual[1] = inverse * cross(normal, v[0]);
  } else if (rank == 3) {
    const double inverse = 1 / dot(v[0], cross(v[1], v[2]));
    dual[0] = inverse * cross(v[1], v[2]);
    dual[1] = inverse * cross(v[2], v[0]);
    dual[2] = inverse * cross(v[0], v[1]);
  }
  for (std::size_t k = 0; k < 3; ++k) dual[k] = scale[k] * dual[k];
  return dual;
}

}  // namespace dch::detail
