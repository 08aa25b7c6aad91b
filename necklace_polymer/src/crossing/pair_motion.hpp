// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <dch/base/vec3.hpp>
#include <dch/necklace/bond_encounter.hpp>

namespace dch::necklace::detail {

/// How far rounding may have moved a coordinate of an end of a bond, as a share of MovingBond's magnitude: a
/// position plus up to three multiples of cell vectors has seven roundings, each of at most half an epsilon
/// of no more than the magnitude.
inline constexpr double kEndError = 8 * std::numeric_limits<double>::epsilon();

inline double largest(Vec3 a) { return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}); }

/// Two bonds in doubles, with a bound on what rounding has done to them. All motion is linear over 0 <= t
/// <= 1.
struct PairMotion {
  PairMotion(const MovingBond& first, const MovingBond& second, double magnitude)
      : p{first.to_a - first.from_a, first.to_b - first.from_b},
        q{second.to_a - second.from_a, second.to_b - second.from_b},
        origin_p{first.from_a, first.from_b},
        origin_q{second.from_a, second.from_b},
        error(2 * kEndError * magnitude) {
    bond_p = {first.from_b - first.from_a, first.to_b - first.to_a};
    bond_q = {second.from_b - second.from_a, second.to_b - second.to_a};
    between = {second.from_a - first.from_a, second.to_a - first.to_a};
    for (const Vec3 v : {bond_p[0], bond_p[1], bond_q[0], bond_q[1], between[0], between[1]})
      size = std::max(size, largest(v));
  }

  std::array<Vec3, 2> p, q;                ///< displacements of the ends
  std::array<Vec3, 2> origin_p, origin_q;  ///< the ends at t = 0
  std::array<Vec3, 2> bond_p{}, bond_q{},
      between{};     ///< at t = 0 and t = 1; between: from P's first to Q's first
  double error = 0;  ///< of each component of bond_p, bond_q and between
  double size = 0;   ///< no component of these is larger at any time

  static Vec3 at(const std::array<Vec3, 2>& v, double t) { return (1 - t) * v[0] + t * v[1]; }

  /// No point of one bond moves faster against one of the other.
  double largest_speed() const {
    double speed2 = 0;
    for (const Vec3 a : p) {
      for (const Vec3 b : q) speed2 = std::max(speed2, norm2(a - b));
    }
    return std::sqrt(speed2);
  }
};

}  // namespace dch::necklace::detail
