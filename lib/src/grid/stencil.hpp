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

/// The longest of a vector's components.
double longest(Vec3 sides);

}  // namespace dch::detail
