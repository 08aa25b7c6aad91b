// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include <dch/base/vec3.hpp>

namespace dch::zonotope {

/// Up to four points, and where their convex hull comes closest to the origin.
struct Simplex {
  std::array<Vec3, 4> points;
  std::array<Vec3, 4> directions;  ///< along which the points are extreme
  std::array<double, 4> weights{};
  int count = 0;

  void add(Vec3 point, Vec3 direction);
  /// The point closest to the origin. Points that it does not need are left out.
  Vec3 reduce();
};

}  // namespace dch::zonotope
