// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include <dch/geometry/box.hpp>

namespace dch::detail {

/// Lattice vectors as integer multiples of the cell vectors as given; along open axes the integers are 0.
class Lattice {
 public:
  explicit Lattice(const Box& box);

  /// Of a lattice vector up to rounding.
  Vec3 integers(Vec3 v) const;
  Vec3 vector(Vec3 n) const { return n.x * cell_[0] + n.y * cell_[1] + n.z * cell_[2]; }

 private:
  std::array<Vec3, 3> cell_{}, dual_{};
};

}  // namespace dch::detail
