// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

#include "matrix.hpp"

namespace dch::kinetic {

/// How the box changes between two frames, and what that does to points that move in straight lines.
///
/// Each reduced period of the earlier box moves in a straight line to the nearest vector of the later
/// lattice. That is the linear map 1 + G of the periodic span. A pair whose images are d apart in the earlier
/// frame is (1 + t G) d + t (v_j - v_i) apart at the time t in [0, 1], for every image: v is the displacement
/// of a point beyond what the map does to it, which is the same for all its images.
class BoxChange {
 public:
  BoxChange(const Box& before, const Box& after);

  /// Why images cannot be followed; empty if they can.
  const std::string& fault() const { return fault_; }
  /// At t = 1/2.
  const Box& middle() const { return middle_; }
  /// At least the factor by which the map makes a vector longer, less 1.
  double strain() const { return strain_; }

  /// v of a point at p, and then at q: of all images the shortest.
  Vec3 displacement(Vec3 p, Vec3 q) const {
    return after_.nearest_image(is_none_ ? q - p : q - (p + shift_ + growth_ * (p - origin_)));
  }
  /// What of a displacement lies along periods: all of it if there are three.
  Vec3 along_periods(Vec3 displacement) const;
  /// Whether another image is as likely the one that the point has gone to.
  bool is_ambiguous(Vec3 displacement) const;
  /// Where such a point is at t = 1/2; in any image.
  Vec3 middle_of(Vec3 p, Vec3 displacement) const {
    const Vec3 there = p + 0.5 * displacement;
    return is_none_ ? there : there + 0.5 * (shift_ + growth_ * (p - origin_));
  }
  /// d/dt of how far two points are apart, if they are `apart` at t = 1/2.
  /// @param slip v_j - v_i
  Vec3 rate(Vec3 apart, Vec3 slip) const { return is_none_ ? slip : slip + turn_ * (apart - 0.5 * slip); }

 private:
  void follow(const Box& before);

  Box after_, middle_;
  std::string fault_;
  bool is_none_ = true;
  double strain_ = 0;
  Vec3 origin_, shift_;  ///< of the earlier box, and what the later one's is off along the periods
  Matrix growth_;        ///< G
  Matrix turn_;          ///< G (1 + G/2)^-1
};

}  // namespace dch::kinetic
