// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/vec3.hpp>

#include "predicates.hpp"
#include "vectors.hpp"

namespace dch::zonotope {

/// v or -v, whichever has a positive first coordinate that is not 0.
inline Vec3 in_half_space(Vec3 v) {
  const double first = v.x != 0 ? v.x : v.y != 0 ? v.y : v.z;
  return first < 0 ? -1.0 * v : v;
}

/// An order of the directions of vectors that in_half_space() gave, by the slopes y/x and z/x; 0 for parallel
/// ones. Without rounding.
inline int compare_directions(Vec3 a, Vec3 b) {
  const int rank_a = a.x != 0 ? 0 : a.y != 0 ? 1 : 2, rank_b = b.x != 0 ? 0 : b.y != 0 ? 1 : 2;
  if (rank_a != rank_b) return rank_a < rank_b ? -1 : 1;
  if (rank_a == 2) return 0;
  if (rank_a == 1) return sign_of_cross({b.y, b.z}, {a.y, a.z});
  const int by_y = sign_of_cross({b.x, b.y}, {a.x, a.y});
  return by_y != 0 ? by_y : sign_of_cross({b.x, b.z}, {a.x, a.z});
}

}  // namespace dch::zonotope
