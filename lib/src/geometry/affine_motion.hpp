// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

namespace dch::detail {

/// How particles move that go along with a change of the periodic vectors: each keeps its fractional
/// coordinates along them, and its place at right angles to them.
class AffineMotion {
 public:
  /// @param before in which particles were
  /// @param periods,now the reduced vectors of that box, and what they have become; the first rank() are set
  AffineMotion(const Box& before, const std::array<Vec3, 3>& periods, const std::array<Vec3, 3>& now,
               Vec3 origin_now);

  Vec3 operator()(Vec3 p) const {
    const Vec3 d = p - origin_;
    return p + (d.x * change_[0] + d.y * change_[1] + d.z * change_[2] + shift_);
  }

  /// No displacement becomes shorter than by this factor, rounding included; from 0 to 1.
  double least_stretch() const;

 private:
  Vec3 origin_, shift_;
  std::array<Vec3, 3> change_{};  ///< of the unit vectors
};

}  // namespace dch::detail
