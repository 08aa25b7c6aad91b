// SPDX-License-Identifier: MIT
#include "geometry/affine_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dch::detail {

AffineMotion::AffineMotion(const Box& before, const std::array<Vec3, 3>& periods,
                           const std::array<Vec3, 3>& now, Vec3 origin_now)
    : origin_(before.origin()) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(before.rank()); ++k) {
    const Vec3 dual = before.reduced_dual()[k], change = now[k] - periods[k];
    for (int axis = 0; axis < 3; ++axis)
      change_[static_cast<std::size_t>(axis)] = change_[static_cast<std::size_t>(axis)] + dual[axis] * change;
    shift_ = shift_ + dot(dual, origin_now - origin_) * periods[k];
  }
}

// |F d|^2 = d.C d with the columns f_k of F and C_kl = f_k.f_l. By Gershgorin's theorem no eigenvalue of C is
// less than the least of C_kk - sum of |C_kl|, l != k: to first order in the change this is exact for
// stretches along the axes, and in a plane for any.
double AffineMotion::least_stretch() const {
  constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();
  const std::array<Vec3, 3> f{Vec3{1, 0, 0} + change_[0], Vec3{0, 1, 0} + change_[1],
                              Vec3{0, 0, 1} + change_[2]};
  const double xy = std::abs(dot(f[0], f[1])), xz = std::abs(dot(f[0], f[2])), yz = std::abs(dot(f[1], f[2]));
  const double least = std::min({norm2(f[0]) - xy - xz, norm2(f[1]) - xy - yz, norm2(f[2]) - xz - yz});
  return std::sqrt(std::min(std::max(least - kRounding, 0.0), 1.0));
}

}  // namespace dch::detail
