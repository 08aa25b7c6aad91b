// SPDX-License-Identifier: MIT
#include "point_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dch::detail {
namespace {

constexpr double kMostCells = 0x1p30;  ///< of a coordinate, from the grid's origin and from that of space
/// Of cells [length]: squares of distances are normal numbers, where they matter.
constexpr double kLeastWidth = 1e-140;
constexpr double kPointsOfACell = 2.5;
/// Narrower cells are tried where points have more company than this in theirs.
constexpr double kMostCompany = 7;
constexpr int kTries = 4;
/// Ids to come, as a multiple of those that there are, before cells are too full.
constexpr std::size_t kGrowth = 3;
/// Of points in an overfull cell, which are more than can be counted.
constexpr double kOverfullCompany = 100;
/// A few points may have more lines than there are of them.
constexpr std::size_t kLeastLines = 64;
constexpr PointCells::Line kEmptyLine{{}, {kNone, kNone, kNone, kNone, kNone, kNone}, kNone};
constexpr int kAliases = 16;  ///< cells after which coordinates start anew
/// Odd numbers without a pattern.
constexpr std::uint64_t kMixers[3] = {0x9E3779B97F4A7C15u, 0xC2B2AE3D27D4EB4Fu, 0x165667B19E3779F9u};

std::int64_t modulo(std::int64_t cell, std::int64_t cells) {
  if (cell >= 0 && cell < cells) return cell;
  const std::int64_t rest = cell % cells;
  return rest < 0 ? rest + cells : rest;
}

struct Bounds {
  Vec3 low, high;
};

Bounds bounds_of(const Structure& structure) {
  constexpr double kMost = std::numeric_limits<double>::infinity();
  Bounds bounds{{kMost, kMost, kMost}, {-kMost, -kMost, -kMost}};
  for (std::size_t k = 0; k < structure.raw.size(); ++k) {
    if (!structure.contains(static_cast<std::int32_t>(k))) continue;
    for (int axis = 0; axis < 3; ++axis) {
      bounds.low[axis] = std::min(bounds.low[axis], structure.raw[k][axis]);
      bounds.high[axis] = std::max(bounds.high[axis], structure.raw[k][axis]);
    }
  }
  return bounds;
}

/// Of cells with so many points in the mean, where these lie in a brick. One layer of cells holds those of a
/// plane.
double width_for(std::array<double, 3> extents, double points) {
  std::sort(extents.begin(), extents.end());
  const double of_three = std::cbrt(kPointsOfACell / points * extents[0] * extents[1] * extents[2]);
  if (of_three < extents[0]) return of_three;
  const double of_two = std::sqrt(kPointsOfACell / points * extents[1] * extents[2]);
  return of_two < extents[1] ? of_two : kPointsOfACell / points * extents[2];
}

}  // namespace

void PointCells::clear() {
  is_made_ = false;
  lines_.clear();
  line_of_id_.clear();
}

void PointCells::make(const Structure& structure, double width) {
  clear();
  if (structure.count() == 0 || !choose_axes(structure, width)) return;
  take_all(structure);
}

void PointCells::make(const Structure& structure) {
  clear();
  if (structure.count() == 0 || structure.box.kind() == Box::Kind::triclinic) return;
  const Bounds bounds = bounds_of(structure);
  std::array<double, 3> extents{};
  for (int axis = 0; axis < 3; ++axis)
    extents[static_cast<std::size_t>(axis)] = structure.box.periodic(axis)
                                                  ? structure.box.vector(axis)[axis]
                                                  : bounds.high[axis] - bounds.low[axis];
  double width = width_for(extents, static_cast<double>(structure.count()));
  for (int k = 0; k < kTries; ++k) {
    make(structure, width);
    if (empty()) return;
    const double company = mean_company();
    if (company < kMostCompany) return;
    width *= std::cbrt((kPointsOfACell + 1) / company);
  }
}

bool PointCells::choose_axes(const Structure& structure, double width) {
  if (structure.box.kind() == Box::Kind::triclinic || !(width >= kLeastWidth)) return false;
  const Bounds bounds = bounds_of(structure);
  double lines = 1;  // where each cell has one
  for (int k = 0; k < 3; ++k) {
    Axis& axis = axes_[static_cast<std::size_t>(k)];
    const bool is_periodic = structure.box.periodic(k);
    axis.origin = is_periodic ? structure.box.origin()[k] : bounds.low[k];
    axis.length = is_periodic ? structure.box.vector(k)[k] : bounds.high[k] - bounds.low[k];
    const double cells = std::floor(axis.length / width);
    if (!(cells < kMostCells)) return false;
    axis.cells = is_periodic ? static_cast<std::int64_t>(cells) : 0;
    axis.rows = static_cast<std::int64_t>(cells) + (is_periodic ? 0 : 1);
    axis.width = width;
    lines *= static_cast<double>(axis.rows);
  }
  if (lines <= static_cast<double>(kLeastLines + structure.count())) {
    line_by_rows(static_cast<std::size_t>(lines));
  } else {
    line_by_table(structure.count());
  }
  return fit_widths(structure.box);
}

/// Cells in a row, rows side by side. Cells beyond share lines with those of the first rows.
void PointCells::line_by_rows(std::size_t lines) {
  first_lines_ = lines;
  shift_ = 0;
  std::uint64_t stride = 1;
  for (std::size_t k = 3; k-- > 0;) {
    axes_[k].stride = stride;
    stride *= static_cast<std::uint64_t>(axes_[k].rows);
  }
}

/// The upper bits of a sum tell the line. Two cells on one line that a question looks at must not have the
/// same upper bits of coordinates, so a period is a multiple of the cells after which these start anew.
void PointCells::line_by_table(std::size_t points) {
  unsigned bits = 1;
  while ((std::size_t{1} << bits) < points / 2) ++bits;
  first_lines_ = std::size_t{1} << bits;
  shift_ = 64 - bits;
  for (std::size_t k = 0; k < 3; ++k) {
    axes_[k].cells -= axes_[k].cells % kAliases;
    axes_[k].rows = 0;
    axes_[k].stride = kMixers[k];
  }
}

/// A period is a whole number of cells, of so many that a question looks at none twice.
bool PointCells::fit_widths(const Box& box) {
  least_width_ = std::numeric_limits<double>::infinity();
  most_width_ = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    Axis& axis = axes_[k];
    if (box.periodic(static_cast<int>(k))) {
      if (axis.cells <= kMostAlong) return false;
      axis.width = axis.length / static_cast<double>(axis.cells);
    }
    axis.per_length = 1 / axis.width;
    least_width_ = std::min(least_width_, axis.width);
    most_width_ = std::max(most_width_, axis.width);
  }
  return true;
}

void PointCells::take_all(const Structure& structure) {
  lines_.reserve(first_lines_ + first_lines_ / 4);
  lines_.assign(first_lines_, kEmptyLine);
  spare_ = kNone;
  most_ids_ = kGrowth * structure.raw.size();
  line_of_id_.assign(structure.raw.size(), kNone);
  for (std::size_t k = 0; k < structure.raw.size() && !lines_.empty(); ++k) {
    const auto id = static_cast<std::int32_t>(k);
    if (structure.contains(id)) insert(id, structure.raw[k]);
  }
  is_made_ = !lines_.empty();
}

/// How many points the line of a point has in the mean.
double PointCells::mean_company() const {
  double points = 0, company = 0;
  for (std::size_t k = 0; k < first_lines_; ++k) {
    double here = 0;
    auto line = static_cast<std::int32_t>(k);
    for (; line >= 0; line = lines_[static_cast<std::size_t>(line)].next)
      for (const std::int32_t id : lines_[static_cast<std::size_t>(line)].id) here += id != kNone;
    points += here;
    company += line == kOverfull ? kOverfullCompany * here : here * here;
  }
  return company / points;
}

void PointCells::grow(std::size_t ids) {
  if (ids > most_ids_) return clear();  // cells would be too full
  line_of_id_.resize(ids, kNone);
}

bool PointCells::locate(Vec3 at, std::array<double, 3>& cells) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const Axis& axis = axes_[k];
    const double x = at[static_cast<int>(k)];
    if (!((std::abs(x) + std::abs(axis.origin)) * axis.per_length < kMostCells)) return false;
    cells[k] = (x - axis.origin) * axis.per_length;
    if (axis.cells == 0) continue;
    const auto period = static_cast<double>(axis.cells);
    if (cells[k] < 0 || cells[k] >= period) cells[k] -= period * std::floor(cells[k] / period);
    // What rounds to a whole period, and what is so little below 0 that its share of a period rounds to none.
    if (cells[k] < 0 || cells[k] >= period) cells[k] = 0;
  }
  return true;
}

PointCells::Coordinate PointCells::coordinate(std::size_t axis, std::int64_t cell, std::int64_t units) const {
  const Axis& a = axes_[axis];
  const std::int64_t image = a.cells > 0 ? modulo(cell, a.cells) : cell;
  return {part(a, image), static_cast<std::uint16_t>(units - (cell - image) * kUnits),
          static_cast<std::uint16_t>(image * kUnits)};
}

std::uint64_t PointCells::part(const Axis& axis, std::int64_t cell) {
  return axis.stride * static_cast<std::uint64_t>(axis.rows > 0 ? modulo(cell, axis.rows) : cell);
}

bool PointCells::place(Vec3 at, Place& place) const {
  std::array<double, 3> cells{};
  if (!locate(at, cells)) return false;
  std::uint64_t parts = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto units = static_cast<std::int64_t>(std::floor(cells[k] * kUnits));
    place.units[k] = static_cast<std::uint16_t>(units);
    parts += part(axes_[k], units >> kBits);
  }
  place.line = line_of(parts);
  return true;
}

void PointCells::insert(std::int32_t id, Vec3 at) {
  Place to;
  if (!place(at, to)) return clear();
  const std::int32_t last = line_with_room(to.line);
  if (last == kNone) return;
  Line& line = lines_[static_cast<std::size_t>(last)];
  const auto slot = std::find(line.id, line.id + kPoints, kNone) - line.id;
  for (std::size_t k = 0; k < 3; ++k) line.at[k][slot] = to.units[k];
  line.id[slot] = id;
  line_of_id_[static_cast<std::size_t>(id)] = to.line;
}

void PointCells::prefetch(std::int32_t id, Vec3 at) const {
  const std::int32_t from = line_of_id_[static_cast<std::size_t>(id)];
  if (from != kNone) __builtin_prefetch(&line(from), 1);
  Place to;
  if (place(at, to)) __builtin_prefetch(&line(to.line), 1);
}

/// kNone if there is none, and the cell is overfull from then on.
std::int32_t PointCells::line_with_room(std::int32_t line) {
  for (int lines = 1;; ++lines) {
    const Line& here = lines_[static_cast<std::size_t>(line)];
    if (std::find(here.id, here.id + kPoints, kNone) != here.id + kPoints) return line;
    if (here.next == kOverfull) return kNone;
    if (here.next == kNone) {
      const std::int32_t next = lines < kMostLines ? new_line() : kOverfull;
      lines_[static_cast<std::size_t>(line)].next = next;
      return next == kOverfull ? kNone : next;
    }
    line = here.next;
  }
}

std::int32_t PointCells::new_line() {
  if (spare_ == kNone) {
    lines_.push_back(kEmptyLine);
    return static_cast<std::int32_t>(lines_.size()) - 1;
  }
  const std::int32_t line = spare_;
  spare_ = std::exchange(lines_[static_cast<std::size_t>(line)].next, kNone);
  return line;
}

void PointCells::remove(std::int32_t id) {
  std::int32_t line = std::exchange(line_of_id_[static_cast<std::size_t>(id)], kNone), before = kNone;
  for (; line >= 0; before = std::exchange(line, lines_[static_cast<std::size_t>(line)].next)) {
    Line& here = lines_[static_cast<std::size_t>(line)];
    std::int32_t* const found = std::find(here.id, here.id + kPoints, id);
    if (found == here.id + kPoints) continue;
    *found = kNone;
    if (before != kNone && std::count(here.id, here.id + kPoints, kNone) == kPoints) {
      lines_[static_cast<std::size_t>(before)].next = std::exchange(here.next, spare_);
      spare_ = line;
    }
    return;
  }
}

}  // namespace dch::detail
