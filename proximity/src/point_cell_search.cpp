// SPDX-License-Identifier: MIT
#include "point_cell_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dch::detail {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
/// Cells that a question looks at, and more for each point that it wants: a descent takes no longer.
constexpr std::int64_t kMostLookedAt = 64, kMoreLookedAt = 2;
constexpr double kFarInCells = 1e6;
constexpr std::size_t kUsual = 128;      ///< points found: hardly a question finds more
constexpr std::uint16_t kName = 0xF000;  ///< of the cell, in coordinates

}  // namespace

bool PointCellSearch::within(const PointCells& grid, Vec3 at, double distance) {
  if (!start(grid, at) || !collect(touched_by(distance), {}, distance) || !look_at_cells()) return false;
  keep_within(distance);
  return true;
}

/// The eight nearest cells first, which mostly have the answer. Then those that a point as far as the k-th
/// one may be in, or all around.
///
/// Cells whose coordinates differ by multiples of 16 have the same name and may share a line. So among the
/// points found there may be some of cells that were not asked for, with smaller distances than they have,
/// and the bound may be below the distance of the k-th nearest point. Whether it is shows who computes
/// distances: if k points found are within the bound, the answer is right. Proof, with bound B, and distances
/// as Box::distance2() computes them:
/// - A point of a cell that was looked at is by integers as far as that, up to kSteps. So keep_within(B)
/// keeps
///   all of them that are within B.
/// - Bounds only shrink from round to round, as points are added. So a cell that was left out in some round
/// is
///   farther than B, with kRounding taken off on each axis, and so are its points.
/// - Cells beyond those of the last round are farther than B / (1 + epsilon), with kRounding taken off, and
/// so
///   are their points.
/// So with epsilon = 0 all points within B are among those found, the k nearest included. Else the j-th
/// nearest one is among them, or is farther than B / (1 + epsilon), while the j-th one found is within B.
/// Without points of other cells k points are always within the bound.
///
/// The last round comes: the cells that `needed` touches have it as their clearance, and it does not grow.
bool PointCellSearch::nearest(const PointCells& grid, Vec3 at, std::int32_t k, double epsilon) {
  if (!start(grid, at)) return false;
  const std::int64_t most = kMostLookedAt + kMoreLookedAt * k;
  Ranges seen{}, ranges = nearest_eight();
  bound_ = kFar;
  for (;;) {
    if (ranges[0].size() * ranges[1].size() * ranges[2].size() > most) return false;
    if (!collect(ranges, seen, bound_) || !look_at_cells()) return false;
    seen = ranges;
    bound_ = distance_of(static_cast<std::size_t>(k));
    const double needed = bound_ / (1 + epsilon);
    if (needed <= clearance(seen)) break;
    ranges = both(seen, bound_ < kFar ? touched_by(needed) : wider(seen));
  }
  keep_within(bound_);
  return true;
}

bool PointCellSearch::start(const PointCells& grid, Vec3 at) {
  grid_ = &grid;
  size_ = 0;
  if (!grid.locate(at, at_)) return false;
  for (std::size_t axis = 0; axis < 3; ++axis)
    units_[axis] = static_cast<std::int64_t>(std::floor(at_[axis] * PointCells::kUnits));
  return true;
}

PointCellSearch::Ranges PointCellSearch::nearest_eight() const {
  Ranges ranges;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t low = (units_[axis] - PointCells::kUnits / 2) >> PointCells::kBits;
    ranges[axis] = {low, low + 1};
  }
  return ranges;
}

PointCellSearch::Ranges PointCellSearch::touched_by(double distance) const {
  Ranges ranges;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double cells = std::min(
        distance / grid_->width(axis) * (1 + PointCells::kRounding) + PointCells::kRounding, kFarInCells);
    ranges[axis] = {static_cast<std::int64_t>(std::floor(at_[axis] - cells)),
                    static_cast<std::int64_t>(std::floor(at_[axis] + cells))};
  }
  return ranges;
}

PointCellSearch::Ranges PointCellSearch::wider(Ranges ranges) {
  for (Range& range : ranges) range = {range.low - 1, range.high + 1};
  return ranges;
}

PointCellSearch::Ranges PointCellSearch::both(const Ranges& a, const Ranges& b) {
  Ranges ranges;
  for (std::size_t axis = 0; axis < 3; ++axis)
    ranges[axis] = {std::min(a[axis].low, b[axis].low), std::max(a[axis].high, b[axis].high)};
  return ranges;
}

/// No point that is in other cells is as near [length].
double PointCellSearch::clearance(const Ranges& ranges) const {
  double least = kFar;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double below = at_[axis] - static_cast<double>(ranges[axis].low);
    const double above = static_cast<double>(ranges[axis].high + 1) - at_[axis];
    least = std::min(least, (std::min(below, above) - PointCells::kRounding) * grid_->width(axis));
  }
  return least;
}

/// Squared distance to a cell along an axis [length^2].
double PointCellSearch::gap2(std::size_t axis, std::int64_t cell) const {
  const double below = static_cast<double>(cell) - at_[axis];
  const double above = at_[axis] - static_cast<double>(cell + 1);
  const double gap = std::max({below, above, PointCells::kRounding}) - PointCells::kRounding;
  return gap * gap * grid_->width(axis) * grid_->width(axis);
}

/// Cells within a distance that have not been seen; their lines are on the way from memory then.
bool PointCellSearch::collect(const Ranges& ranges, const Ranges& seen, double distance) {
  std::array<std::array<Layer, PointCells::kMostAlong>, 3> layers;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (ranges[axis].size() > PointCells::kMostAlong) return false;
    for (std::int64_t cell = ranges[axis].low; cell <= ranges[axis].high; ++cell)
      layers[axis][static_cast<std::size_t>(cell - ranges[axis].low)] = {
          grid_->coordinate(axis, cell, units_[axis]), gap2(axis, cell), seen[axis].has(cell)};
  }
  const auto layers_of = [&](std::size_t axis) {
    return Span<const Layer>(layers[axis].data(), static_cast<std::size_t>(ranges[axis].size()));
  };
  cells_.clear();
  for (const Layer& x : layers_of(0))
    for (const Layer& y : layers_of(1))
      for (const Layer& z : layers_of(2)) {
        if ((x.seen && y.seen && z.seen) || x.gap2 + y.gap2 + z.gap2 > distance * distance) continue;
        cells_.push_back({grid_->line_of(x.at.part + y.at.part + z.at.part),
                          {x.at.query, y.at.query, z.at.query},
                          {x.at.cell, y.at.cell, z.at.cell}});
        __builtin_prefetch(&grid_->line(cells_.back().line));
      }
  return true;
}

/// @return false if one is overfull
bool PointCellSearch::look_at_cells() {
  for (const Cell& cell : cells_) {
    std::int32_t line = cell.line;
    for (; line >= 0; line = grid_->line(line).next) look_at(cell, grid_->line(line));
    if (line == PointCells::kOverfull) return false;
  }
  return true;
}

/// Appends the points of the cell, without branches.
void PointCellSearch::look_at(const Cell& cell, const PointCells::Line& line) {
  ++work.blocks;
  if (size_ + PointCells::kPoints > found_.size()) found_.resize(2 * size_ + kUsual);
  for (std::size_t k = 0; k < PointCells::kPoints; ++k) {
    std::uint32_t units2 = 0;
    unsigned other = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint16_t at = line.at[axis][k];
      const std::int32_t d = static_cast<std::int16_t>(at - cell.query[axis]);
      units2 += static_cast<std::uint32_t>(d * d);
      other |= at ^ cell.name[axis];
    }
    found_[size_] = {units2, line.id[k]};
    size_ += static_cast<std::size_t>((other & kName) == 0) & static_cast<std::size_t>(line.id[k] >= 0);
  }
}

/// An upper bound for the k-th point found [length].
double PointCellSearch::distance_of(std::size_t k) {
  if (size_ < k) return kFar;
  const auto nearer = [](const Found& a, const Found& b) { return a.units2 < b.units2; };
  const auto begin = found_.begin(), end = begin + static_cast<std::ptrdiff_t>(size_);
  const auto kth = begin + static_cast<std::ptrdiff_t>(k - 1);
  if (k == 1) {
    std::iter_swap(kth, std::min_element(begin, end, nearer));
  } else {
    std::nth_element(begin, kth, end, nearer);
  }
  return (std::sqrt(static_cast<double>(kth->units2)) + PointCells::kSteps) * grid_->most_width() /
         PointCells::kUnits;
}

void PointCellSearch::keep_within(double distance) {
  const double units = distance / grid_->least_width() * PointCells::kUnits + PointCells::kSteps;
  const double most = units * units;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < size_; ++k) {
    found_[kept] = found_[k];
    kept += static_cast<std::size_t>(found_[k].units2 <= most);
  }
  size_ = kept;
  work.points += static_cast<std::int64_t>(kept);
}

}  // namespace dch::detail
