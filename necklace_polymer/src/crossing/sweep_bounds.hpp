// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <dch/base/vec3.hpp>

namespace dch::necklace::detail {

/// A ball and an axis-parallel box about the center of a bond's sweep that hold all of it, rounded up to
/// single precision. Most pairs are told apart by these alone, without a look at their beads.
struct SweepBounds {
  float radius = -1;            ///< below 0 where the bond is left out [length]
  std::array<float, 3> half{};  ///< widths of the box [length]

  bool is_left_out() const { return radius < 0; }
};

/// @param between from the center of p to that of q
inline bool is_apart_by_ball(const SweepBounds& p, const SweepBounds& q, Vec3 between) {
  const double reach = static_cast<double>(p.radius) + static_cast<double>(q.radius);
  return norm2(between) > reach * reach;
}

inline bool is_apart_by_bounds(const SweepBounds& p, const SweepBounds& q, Vec3 between) {
  const auto beyond = [&](std::size_t k, double distance) {
    return std::abs(distance) - (static_cast<double>(p.half[k]) + static_cast<double>(q.half[k]));
  };
  // One branch: each axis is as likely.
  return std::max({beyond(0, between.x), beyond(1, between.y), beyond(2, between.z)}) > 0;
}

}  // namespace dch::necklace::detail
