// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

#include "grid/cell_layout.hpp"
#include "leaves/rounding.hpp"
#include "simd/bin_points.hpp"

namespace dch::detail {

/// How coordinates become integers: relative to a wrapped point, in units [length]; unit 0 for not yet.
struct CellRounding {
  Vec3 origin;
  double unit = 0;
  friend bool operator==(const CellRounding& a, const CellRounding& b) {
    return a.unit == b.unit && a.origin == b.origin;
  }
};

/// The coordinate of the cell that holds a finest piece.
constexpr std::int32_t cell_of(std::int32_t piece) { return piece >> CellLayout::kHalvings; }

/// A point's coordinates, modulo 2^16.
using RoundedPoint = std::array<std::int16_t, 3>;

class CellRounder {
 public:
  explicit CellRounder(const CellRounding& rounding)
      : origin_(rounding.origin), per_unit_(rounding.unit > 0 ? 1 / rounding.unit : 0) {}
  [[gnu::always_inline]] RoundedPoint operator()(Vec3 wrapped) const {
    const Vec3 at = wrapped - origin_;
    return {rounded(at.x * per_unit_), rounded(at.y * per_unit_), rounded(at.z * per_unit_)};
  }
  Vec3 origin() const { return origin_; }
  double per_unit() const { return per_unit_; }

 private:
  Vec3 origin_;
  double per_unit_;
};

/// Wraps points, tells in which pieces of which cells they are, and rounds their coordinates.
class CellBins {
 public:
  /// @param box must outlive this
  CellBins(const Box& box, const CellLayout& layout, const CellRounding& rounding);

  /// Writes the coordinates of the points' finest pieces of cells, as CellLayout::piece_coordinates has them,
  /// and their rounded coordinates. Where layouts have right angles, pieces are along the axes of space: that
  /// of the k-th direction is number axis(k).
  void find(Span<const Vec3> positions, CellCoordinates* pieces, RoundedPoint* rounded_points) const;
  int axis(std::size_t k) const { return layout_.has_right_angles() ? layout_.axis(k) : static_cast<int>(k); }

 private:
  const Box* box_;
  CellLayout layout_;
  CellRounder round_;
  BinPoints bin_points_ = nullptr;  ///< null where sides or cells have no right angles
  BrickBins bricks_;
};

}  // namespace dch::detail
