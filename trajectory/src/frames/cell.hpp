// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include <dch/base/error.hpp>
#include <dch/geometry/box.hpp>

namespace dch::trajectory {

/// The cell of a frame as a file gives it: three edge vectors, the corner they start from, periodicity.
struct Cell {
  std::array<Vec3, 3> edges{};
  Vec3 origin{};
  Box::Periodic periodic{true, true, true};

  /// All numbers are zero: files say so for "no box".
  bool is_zero() const { return edges == std::array<Vec3, 3>{} && origin == Vec3{}; }

  /// The box: none if is_zero().
  /// @throws InvalidBox.
  Box box() const;
};

/// A coordinate that the library accepts: a number, not beyond kMaxCoordinate.
inline bool is_valid_coordinate(double x) { return std::abs(x) <= kMaxCoordinate; }
inline bool is_valid_position(Vec3 p) {
  return is_valid_coordinate(p.x) && is_valid_coordinate(p.y) && is_valid_coordinate(p.z);
}

}  // namespace dch::trajectory
