// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "grid/cell_layout.hpp"

namespace dch::detail {

/// A row of cells near a cell, in relative coordinates.
struct StencilRow {
  std::int32_t y, z, first, last;
};

/// The cells within `reach` of a cell that come after it: of each pair of cells near each other one has the
/// other in this half of those around it. None if the reach is 0.
std::vector<StencilRow> half_stencil(const CellLayout& layout, double reach);

/// Largest difference of coordinates of a point of a cell and one of the stencil [length].
double widest_in(const CellLayout& layout, const std::vector<StencilRow>& stencil);

/// Brings a cell coordinate into the period, and says by how many periods it was off.
inline std::int32_t wrap(std::int32_t& c, std::int32_t cells) {
  const std::int32_t away = c >= 0 ? c - cells : -1 - c;  // most are in the next period, or in this one
  const std::int32_t periods = away < 0       ? 0
                               : away < cells ? (c >= 0 ? 1 : -1)
                               : c >= 0       ? c / cells
                                              : -((cells - 1 - c) / cells);
  c -= periods * cells;
  return periods;
}

/// The longest of a vector's components.
double longest(Vec3 sides);

}  // namespace dch::detail
