// SPDX-License-Identifier: MIT
#include "close_grid.hpp"

#include <algorithm>
#include <cmath>

namespace dch::detail {
namespace {

constexpr std::size_t kMostPlaces = std::size_t{1} << 30;
constexpr double kMostCells = 0x1p30;  ///< of a coordinate, from the grid's origin and from that of space
/// Cells are so many times as wide as the reach that is asked for: it may grow before they are too narrow.
constexpr double kWider = 2.5;

}  // namespace

void CloseGrid::make(const Box& box, Span<const Vec3> positions, const std::vector<char>& is_there,
                     double reach, double slack) {
  clear();
  width_ = kWider * reach;
  slack_ = slack;
  if (box.kind() == Box::Kind::triclinic || !(std::isfinite(1 / width_) && slack < width_)) return;
  origin_ = box.origin();
  for (int axis = 0; axis < 3; ++axis) {
    const double length = box.periodic(axis) ? box.vector(axis)[axis] : 0;
    cells_[axis] = static_cast<std::int64_t>(std::min(std::floor(length / width_), kMostCells));
    if (box.periodic(axis) && cells_[axis] < 1) return;
    per_length_[axis] = box.periodic(axis) ? static_cast<double>(cells_[axis]) / length : 1 / width_;
  }
  std::size_t places = 1;
  while (places < 2 * positions.size() && places < kMostPlaces) places *= 2;
  first_.assign(places, kNone);
  links_.resize(positions.size());
  for (std::size_t k = 0; k < positions.size() && !empty(); ++k)
    if (is_there[k] != 0) insert(static_cast<std::int32_t>(k), positions[k]);
}

bool CloseGrid::has_place(Vec3 at) const {
  bool fits = true;
  for (int axis = 0; axis < 3; ++axis)
    fits = fits && (std::abs(at[axis]) + std::abs(origin_[axis])) * per_length_[axis] < kMostCells;
  return fits;
}

std::size_t CloseGrid::place_of(std::array<std::int64_t, 3> cell) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t cells = cells_[axis];
    if (cells == 0 || (cell[axis] >= 0 && cell[axis] < cells)) continue;
    cell[axis] %= cells;
    if (cell[axis] < 0) cell[axis] += cells;
  }
  // Odd numbers without a pattern, and the upper half of the bits, which all of the lower ones have a part
  // in.
  const std::uint64_t mixed = static_cast<std::uint64_t>(cell[0]) * 0x9E3779B97F4A7C15u ^
                              static_cast<std::uint64_t>(cell[1]) * 0xC2B2AE3D27D4EB4Fu ^
                              static_cast<std::uint64_t>(cell[2]) * 0x165667B19E3779F9u;
  return static_cast<std::size_t>((mixed * 0x9E3779B97F4A7C15u) >> 32) & (first_.size() - 1);
}

void CloseGrid::insert(std::int32_t id, Vec3 at) {
  if (!has_place(at)) return clear();
  std::array<std::int64_t, 3> cell{};
  for (int axis = 0; axis < 3; ++axis)
    cell[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor(in_cells(at, axis)));
  const std::size_t place = place_of(cell);
  Link& link = links_[static_cast<std::size_t>(id)];
  link = {first_[place], kNone, static_cast<std::int32_t>(place)};
  if (link.next != kNone) links_[static_cast<std::size_t>(link.next)].previous = id;
  first_[place] = id;
}

void CloseGrid::remove(std::int32_t id) {
  const Link link = links_[static_cast<std::size_t>(id)];
  if (link.next != kNone) links_[static_cast<std::size_t>(link.next)].previous = link.previous;
  if (link.previous != kNone) {
    links_[static_cast<std::size_t>(link.previous)].next = link.next;
  } else {
    first_[static_cast<std::size_t>(link.place)] = link.next;
  }
}

}  // namespace dch::detail
