// SPDX-License-Identifier: MIT
#include "grid/stencil.hpp"

#include <algorithm>
#include <cmath>

namespace dch::detail {

std::vector<StencilRow> half_stencil(const CellLayout& layout, double reach) {
  std::vector<StencilRow> rows;
  if (reach == 0) return rows;
  layout.for_each_row_near({0, 0, 0}, {1, 1, 1}, reach,
                           [&](std::int32_t y, std::int32_t z, std::int32_t first, std::int32_t last) {
                             if (z < 0 || (z == 0 && y < 0)) return;
                             if (z == 0 && y == 0) first = 1;
                             if (first <= last) rows.push_back({y, z, first, last});
                           });
  return rows;
}

double longest(Vec3 sides) { return std::max({std::abs(sides.x), std::abs(sides.y), std::abs(sides.z)}); }

double widest_in(const CellLayout& layout, const std::vector<StencilRow>& stencil) {
  const Vec3 sides = layout.extent();
  double widest = longest(sides);
  for (const StencilRow& row : stencil)
    for (const std::int32_t x : {row.first, row.last}) {
      const Vec3 between = static_cast<double>(x) * layout[0].edge +
                           static_cast<double>(row.y) * layout[1].edge +
                           static_cast<double>(row.z) * layout[2].edge;
      for (int axis = 0; axis < 3; ++axis) widest = std::max(widest, std::abs(between[axis]) + sides[axis]);
    }
  return widest;
}

}  // namespace dch::detail
