// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

namespace dch::detail {

/// Calls f(v) for every image v of a displacement that is at most `limit` long, given its nearest image.
/// @param half Only one of each pair +-v, the null vector left out: of a node's displacement to itself.
template <class F>
void for_each_near_image(const Box& box, Vec3 nearest, double limit, bool half, const F& f) {
  // Along an axis an image n periods from the nearest one is (coordinate + n) heights away.
  int least[3] = {0, 0, 0}, most[3] = {0, 0, 0};
  for (int axis = 0; axis < box.rank(); ++axis) {
    const Vec3 dual = box.reduced_dual()[static_cast<std::size_t>(axis)];
    const double coordinate = dot(nearest, dual), heights = limit * std::sqrt(norm2(dual));
    least[axis] = static_cast<int>(std::ceil(-coordinate - heights - 1e-9));
    most[axis] = static_cast<int>(std::floor(-coordinate + heights + 1e-9));
  }
  const auto& period = box.reduced();
  for (int a = least[0]; a <= most[0]; ++a)
    for (int b = least[1]; b <= most[1]; ++b)
      for (int c = least[2]; c <= most[2]; ++c) {
        const bool is_later_half = a != 0 ? a > 0 : b != 0 ? b > 0 : c > 0;
        if (half && !is_later_half) continue;
        const Vec3 image = nearest + a * period[0] + b * period[1] + c * period[2];
        if (norm2(image) <= limit * limit) f(image);
      }
}

}  // namespace dch::detail
