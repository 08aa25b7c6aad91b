// SPDX-License-Identifier: MIT
#include "grid/cell_crescents.hpp"

#include <algorithm>
#include <cmath>

#include "grid/stencil.hpp"
#include "leaves/rounding.hpp"

namespace dch::detail {
namespace {

/// Of a distance of rounded points: two points, a shift and the way from then to now, each off by 1/2 along
/// three axes, and what float adds; with room to spare [units].
constexpr double kRounding = 6;
/// Largest coordinate of a cell that is looked at: those of points are far below it.
constexpr double kFarthestCell = 1 << 28;
/// Cells along an axis that a crescent may reach; a larger one holds most points anyway, or goes round the
/// box.
constexpr double kMostCells = 64;

std::int16_t difference(std::int16_t a, std::int16_t b) {
  return static_cast<std::int16_t>(
      static_cast<std::uint16_t>(static_cast<std::uint16_t>(a) - static_cast<std::uint16_t>(b)));
}

}  // namespace

CellCrescents::CellCrescents(CellLayer& layer, Span<const Vec3> positions, const Box& box)
    : layer_(layer), positions_(positions), box_(box) {
  constexpr double kMostUnits = 32000;
  const Vec3 sides = layer.layout().extent();
  farthest_ = std::min({kMostUnits * layer.rounding().unit,
                        kMostCells * std::min({sides.x, sides.y, sides.z}), box.max_cutoff()});
}

bool CellCrescents::any(const Crescent& crescent, const Test& test) const {
  if (!(crescent.outer < farthest_)) return any_of_all(crescent, test);
  const CellRounding& rounding = layer_.rounding();
  const double per_unit = 1 / rounding.unit;
  const CellRounder round(rounding);
  const double outer = crescent.outer * per_unit + kRounding, inner = crescent.inner * per_unit - kRounding;
  const Vec3 now = crescent.middle - crescent.from_now, then = crescent.middle - crescent.from_then;
  const Rounded rounded{round(then), round(now), inner > 0 ? static_cast<float>(inner * inner) : -1.0f,
                        static_cast<float>(outer * outer)};
  Vec3 at = layer_.layout().real_coordinates(crescent.middle);
  for (int k = 0; k < 3; ++k) at[k] = std::clamp(at[k], -kFarthestCell, kFarthestCell);
  bool found = false;
  layer_.layout().for_each_row_near(
      at, at, crescent.radius, [&](std::int32_t y, std::int32_t z, std::int32_t first, std::int32_t last) {
        found = found || any_in_row(rounded, y, z, first, last, test);
      });
  return found;
}

bool CellCrescents::any_of_all(const Crescent& crescent, const Test& test) const {
  const std::int32_t* const id = layer_.at(0).id;
  return std::any_of(id, id + layer_.size(), [&](std::int32_t i) {
    return box_.distance2(crescent.now, box_.wrap(positions_[static_cast<std::size_t>(i)])) <=
               crescent.outer * crescent.outer &&
           test(i);
  });
}

/// Cells first .. last of a row, which may go on beyond the period.
bool CellCrescents::any_in_row(const Rounded& rounded, std::int32_t y, std::int32_t z, std::int32_t first,
                               std::int32_t last, const Test& test) const {
  const CellLayout& layout = layer_.layout();
  Vec3 by;
  if (layout[2].cells > 0) by = by + static_cast<double>(wrap(z, layout[2].cells)) * layout[2].period;
  if (layout[1].cells > 0) by = by + static_cast<double>(wrap(y, layout[1].cells)) * layout[1].period;
  bool found = false;
  const auto look_at = [&](std::int32_t begin, std::int32_t end, Vec3 shift) {
    layer_.for_each_run(begin, end, y, z, false,
                        [&](CellLayer::Run run) { found = found || any_in_run(rounded, shift, run, test); });
  };
  const std::int32_t cells = layout[0].cells;
  if (cells == 0) look_at(first, last, by);
  while (cells > 0 && first <= last && !found) {
    std::int32_t begin = first;
    const std::int32_t periods = wrap(begin, cells), end = std::min(cells - 1, begin + (last - first));
    look_at(begin, end, by + static_cast<double>(periods) * layout[0].period);
    first += end - begin + 1;
  }
  return found;
}

/// @param by what the points of the run are moved by
bool CellCrescents::any_in_run(const Rounded& rounded, Vec3 by, CellLayer::Run run, const Test& test) const {
  const double per_unit = 1 / layer_.rounding().unit;
  RoundedPoint then, now;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int16_t shift = detail::rounded(by[static_cast<int>(axis)] * per_unit);
    then[axis] = difference(rounded.then[axis], shift);
    now[axis] = difference(rounded.now[axis], shift);
  }
  const Candidates points = layer_.at(0);
  const auto distance2 = [&](const RoundedPoint& from, std::int32_t place) {
    const float x = difference(points.x[place], from[0]), y = difference(points.y[place], from[1]),
                z = difference(points.z[place], from[2]);
    return x * x + y * y + z * z;
  };
  for (std::int32_t place = run.begin; place < run.end; ++place)
    if (distance2(now, place) <= rounded.outer2 && distance2(then, place) > rounded.inner2 &&
        test(points.id[place]))
      return true;
  return false;
}

}  // namespace dch::detail
