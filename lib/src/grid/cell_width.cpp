// SPDX-License-Identifier: MIT
#include "grid/cell_width.hpp"

#include <algorithm>
#include <cmath>

#include "grid/stencil.hpp"

namespace dch::detail {
namespace {

constexpr double kSample = 3;  ///< points of the sample, in roots of the number of points: as many pairs of a
                               ///< cell are met in a large scene as in a small one
constexpr double kWidths = 2;  ///< width of a cell of the sample

constexpr double kPoints = 26;      ///< wanted in the cell of a point
constexpr double kNarrowest = 0.3;  ///< width of a cell, in reaches
/// The widest cells, in reaches, and the longest differences of coordinates: the shorter they are, the finer
/// the integers that hold them. With five reaches squares of distances are told to 2/1000 of the reach's.
/// Cells are made narrower by the factor below until differences are no longer.
struct Most {
  double width, difference;
};
constexpr Most kAlone = {3.2, 7};   ///< the wider cells are, the more of few points stand in one
constexpr Most kOthers = {2.4, 5};  ///< where shells have to be told, or wide cells meet more of finer points
constexpr double kNarrower = 0.9;

/// Rows of cells that points of another reach look through: so many of few points, one for so many of others.
constexpr double kFewRows = 64, kPointsOfRow = 4;

/// Numbers that look like random ones, a different one for each k.
std::uint64_t mixed(std::uint64_t k) {
  k = (k + 0x9E3779B97F4A7C15u) * 0xBF58476D1CE4E5B9u;
  k = (k ^ (k >> 27)) * 0x94D049BB133111EBu;
  return k ^ (k >> 31);
}

}  // namespace

double points_nearby(Span<const Vec3> positions, const std::vector<std::int32_t>* members, const Box& box,
                     double width) {
  const std::size_t n = members != nullptr ? members->size() : positions.size();
  if (n < 2) return 1;
  const CellLayout layout(positions, box, kWidths * width);
  const auto count = static_cast<std::size_t>(kSample * std::sqrt(static_cast<double>(n)));
  std::vector<std::uint64_t> cells;
  cells.reserve(count);
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::size_t at = mixed(k) % n;
    const CellCoordinates c = layout.coordinates(
        box.wrap(positions[members != nullptr ? static_cast<std::size_t>((*members)[at]) : at]));
    // One number for each cell, but for accidents.
    std::uint64_t cell = mixed(static_cast<std::uint32_t>(c[0]));
    cell = mixed(cell + static_cast<std::uint32_t>(c[1]));
    cells.push_back(mixed(cell + static_cast<std::uint32_t>(c[2])));
  }
  std::sort(cells.begin(), cells.end());
  double pairs = 0;
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    while (end < count && cells[end] == cells[begin]) ++end;
    pairs += static_cast<double>(end - begin) * static_cast<double>(end - begin - 1);
  }
  const double share = pairs / (static_cast<double>(count) * static_cast<double>(count - 1));
  return 1 + static_cast<double>(n - 1) * share * (width * width * width / layout.cell_volume());
}

/// Each cell takes some work, and each pair of points of cells near each other: with m points in a cell on
/// average and k in that of a point, as much as a / m + b k for a point. So the best k is in proportion to
/// the root of k / m, the spread.
CellLayout cells_for(Span<const Vec3> positions, const Box& box, double reach, double nearby, double spread,
                     CellUse use, double narrowest) {
  const Most& most = use == CellUse::alone ? kAlone : kOthers;
  const double wanted = kPoints * std::sqrt(spread);
  const double least = std::max(narrowest, kNarrowest * reach);
  double width = std::max(least, reach * std::clamp(std::cbrt(wanted / nearby), kNarrowest, most.width));
  for (;; width *= kNarrower) {
    const CellLayout layout(positions, box, width);
    if (width <= least || widest_in(layout, half_stencil(layout, reach)) <= most.difference * reach)
      return layout;
  }
}

double narrowest_cells(double longer_reach, double nearby) {
  return 2 * longer_reach / std::sqrt(std::max(kFewRows, nearby / kPointsOfRow));
}

}  // namespace dch::detail
