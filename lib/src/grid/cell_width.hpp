// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

#include "grid/cell_layout.hpp"

namespace dch::detail {

/// Mean number of points in a cube as wide as `width` around a point, itself counted: of a sample, in cells,
/// so that dense places count as often as points are there.
/// @param members of the points; all, if it is null
double points_nearby(Span<const Vec3> positions, const std::vector<std::int32_t>* members, const Box& box,
                     double width);

/// What cells are for.
enum class CellUse {
  alone,             ///< there are no points in other cells
  alone_with_shell,  ///< the same, and lists have a shell, which has to be told to 2/1000 of the reach's
                     ///< square
  with_finer         ///< their points meet those of finer cells
};

/// The cells in which rows of pairs within `reach` take about the least work.
/// @param nearby as points_nearby() has it for the reach
/// @param spread of the points, see Occupancy
/// @param narrowest cells that others can look through, see narrowest_cells(); 0 if there are no others
CellLayout cells_for(Span<const Vec3> positions, const Box& box, double reach, double nearby, double spread,
                     CellUse use, double narrowest);

/// How narrow cells may be for points of which others look for those within a longer reach: rows of cells
/// there are then not many more than points, however short the reach of the points themselves is.
/// @param nearby points in a cube twice as wide as the longer reach
double narrowest_cells(double longer_reach, double nearby);

}  // namespace dch::detail
