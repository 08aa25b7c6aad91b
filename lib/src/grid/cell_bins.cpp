// SPDX-License-Identifier: MIT
#include "grid/cell_bins.hpp"

#include "geometry/metric.hpp"

namespace dch::detail {
namespace {

BrickBins bricks_of(const BrickCell& box, const CellLayout::Axes& axes, const CellRounder& round) {
  BrickBins bricks;
  for (int k = 0; k < BrickBins::kNumbers; ++k) {
    const int axis = k % 3;
    const auto a = static_cast<std::size_t>(axis);
    bricks.low[k] = box.low[axis];
    bricks.high[k] = box.high[axis];
    bricks.length[k] = box.length[axis];
    bricks.origin[k] = axes.origin[a];
    bricks.per_bin[k] = axes.per_piece[a];
    bricks.least[k] = axes.least[a];
    bricks.most[k] = axes.most[a];
    bricks.zero[k] = round.origin()[axis];
    bricks.per_unit[k] = round.per_unit();
  }
  return bricks;
}

}  // namespace

CellBins::CellBins(const Box& box, const CellLayout& layout, const CellRounding& rounding)
    : box_(&box), layout_(layout), round_(rounding) {
  if (!layout.has_right_angles() || box.kind() == Box::Kind::triclinic) return;
  const BrickCell cell = box.any_periodic() ? OrthorhombicMetric(box).brick() : OpenMetric::brick();
  bricks_ = bricks_of(cell, layout.axes(), round_);
  bin_points_ = bin_points(instruction_set());
}

void CellBins::find(Span<const Vec3> positions, CellCoordinates* pieces, RoundedPoint* rounded_points) const {
  static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(CellCoordinates) == 3 * sizeof(std::int32_t) &&
                sizeof(RoundedPoint) == 3 * sizeof(std::int16_t));
  if (positions.empty()) return;
  if (bin_points_ != nullptr &&
      bin_points_(bricks_, &positions[0].x, static_cast<std::int32_t>(positions.size()), pieces->data(),
                  rounded_points->data()))
    return;
  with_metric(*box_, [&](const auto& metric) {
    for (std::size_t k = 0; k < positions.size(); ++k) {
      const Vec3 at = metric.wrap(positions[k]);
      const CellCoordinates c = layout_.piece_coordinates(at);
      for (std::size_t direction = 0; direction < 3; ++direction)
        pieces[k][static_cast<std::size_t>(axis(direction))] = c[direction];
      rounded_points[k] = round_(at);
    }
  });
}

}  // namespace dch::detail
