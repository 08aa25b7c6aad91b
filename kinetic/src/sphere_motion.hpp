// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <dch/base/vec3.hpp>
#include <dch/kinetic/flight_plan.hpp>

namespace dch::kinetic {

/// The discriminant of |r + v t| = d + g t, over 4, in a form that cancels nothing where r is far longer than
/// d.
inline double contact_discriminant(Vec3 r, Vec3 v, double d, double g) {
  return norm2(d * v - g * r) - norm2(cross(r, v));
}

/// Two spheres that are r apart, move by v relative to each other, and whose distance of contact is d and
/// grows by g >= 0. A pair that grazes has no contact, and neither has one that touches and parts.
class Approach {
 public:
  Approach() = default;
  Approach(Vec3 r, Vec3 v, double d, double g)
      : half_(dot(r, v) - d * g),
        square_(norm2(v) - g * g),
        discriminant_(contact_discriminant(r, v, d, g)),
        excess_(norm2(r) - d * d),
        growth_(g) {}

  /// Without branches, whose outcome is random.
  bool meets() const {
    const int parts = int{half_ >= 0} & (int{growth_ == 0} | int{square_ >= 0});
    return (int{discriminant_ > 0} & ~parts) != 0;
  }
  /// How long until they touch, where they do; slightly negative if rounding has them overlap and they
  /// approach.
  double time_to_contact() const {
    const double root = std::sqrt(discriminant_);
    return half_ < 0 ? excess_ / (root - half_) : (half_ + root) / -square_;
  }

 private:
  double half_ = 0, square_ = 0, discriminant_ = 0, excess_ = 0, growth_ = 0;
};

/// How long a sphere stays in a ball: until it is d + g t off its center, with g <= 0. It is r off now.
inline double time_to_exit(Vec3 r, Vec3 v, double d, double g) {
  const double excess = norm2(r) - d * d;
  if (d <= 0 || excess >= 0) return 0;
  const double half = dot(r, v) - d * g, square = norm2(v) - g * g;
  const double root = std::sqrt(std::max(0.0, half * half - square * excess));
  if (half > 0) return -excess / (half + root);
  return square > 0 ? (root - half) / square : kNever;
}

}  // namespace dch::kinetic
