// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <dch/geometry/box.hpp>

#include "geometry/dual_basis.hpp"

namespace dch::detail {

/// Lattice vectors as integer multiples of the cell vectors as given; along open axes the integers are 0.
class CellImages {
 public:
  explicit CellImages(const Box& box) {
    std::array<Vec3, 3> periods{};
    std::array<std::size_t, 3> axes{};
    int rank = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (!box.periodic(axis)) continue;
      periods[static_cast<std::size_t>(rank)] = cell_[static_cast<std::size_t>(axis)] = box.vector(axis);
      axes[static_cast<std::size_t>(rank++)] = static_cast<std::size_t>(axis);
    }
    const auto dual = dual_basis(periods, rank);
    for (std::size_t k = 0; k < static_cast<std::size_t>(rank); ++k) dual_[axes[k]] = dual[k];
  }

  /// Of a lattice vector up to rounding.
  Vec3 integers(Vec3 v) const {
    return {std::nearbyint(dot(dual_[0], v)), std::nearbyint(dot(dual_[1], v)),
            std::nearbyint(dot(dual_[2], v))};
  }
  Vec3 vector(Vec3 n) const { return n.x * cell_[0] + n.y * cell_[1] + n.z * cell_[2]; }

 private:
  std::array<Vec3, 3> cell_{}, dual_{};
};

}  // namespace dch::detail
