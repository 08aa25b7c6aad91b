// SPDX-License-Identifier: MIT
#include "geometry/lattice.hpp"

#include <cmath>
#include <cstddef>

#include "geometry/dual_basis.hpp"

namespace dch::detail {

Lattice::Lattice(const Box& box) {
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

Vec3 Lattice::integers(Vec3 v) const {
  return {std::nearbyint(dot(dual_[0], v)), std::nearbyint(dot(dual_[1], v)),
          std::nearbyint(dot(dual_[2], v))};
}

}  // namespace dch::detail
