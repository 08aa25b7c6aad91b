// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

namespace dch::detail {

/// Integer coordinates of a cell.
using CellCoordinates = std::array<std::int32_t, 3>;

/// Cells of the reduced lattice: how a periodic or open space is cut into equal parallelepipeds.
class CellLayout {
 public:
  /// Coordinates beyond this many cells from the middle of the points share the outermost cell. Small enough
  /// that the rounding of a coordinate stays below kMargin cells.
  static constexpr double kFarthest = 1 << 30;
  /// How far a point may lie outside of its cell, by rounding [cells].
  static constexpr double kMargin = 1e-6;
  /// A cell is halved so often along each direction to make its finest pieces.
  static constexpr int kHalvings = 2;

  /// One direction: cell coordinate = floor(row . (p - origin)).
  struct Direction {
    Vec3 row;
    Vec3 edge;               ///< from a cell to the next [length]
    std::int32_t cells = 0;  ///< around the torus; 0 if open
    Vec3 period;             ///< reduced lattice vector
    /// What coordinates are cut off at: rounding may leave a wrapped point a little outside.
    double least = -kFarthest, most = kFarthest - 1;
  };

  /// Pieces of cells by the axes of space, where each direction is along one of them: coordinate along an
  /// axis = (p - origin) * per_piece, not below least, not above most, then rounded down. Just as
  /// piece_coordinates() has it.
  struct Axes {
    std::array<double, 3> origin, per_piece, least, most;
  };

  CellLayout() = default;
  /// Cells at least `width` wide between opposite faces (a box narrower than that has one cell there).
  /// `points` are those to be put into them, wrapped or not: they say where the middle of open directions is.
  CellLayout(Span<const Vec3> points, const Box& box, double width);

  const Direction& operator[](std::size_t k) const { return directions_[k]; }
  [[gnu::always_inline]] CellCoordinates coordinates(Vec3 p) const {
    const Vec3 at = p - origin_;
    if (!right_angles_)
      return {cut(0, dot(directions_[0].row, at)), cut(1, dot(directions_[1].row, at)),
              cut(2, dot(directions_[2].row, at))};
    return {cut(0, along_[0] * at[axis_[0]]), cut(1, along_[1] * at[axis_[1]]),
            cut(2, along_[2] * at[axis_[2]])};
  }
  /// The same of the finest pieces of cells, of which there must be fewer than 2^30.
  CellCoordinates piece_coordinates(Vec3 p) const {
    const Vec3 at = p - origin_;
    CellCoordinates c;
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = floored_above(cut_to(pieces_[k], right_angles_ ? kPieces * along_[k] * at[axis_[k]]
                                                            : kPieces * dot(directions_[k].row, at)));
    return c;
  }
  /// Whether each direction is along an axis of space.
  bool has_right_angles() const { return right_angles_; }
  Axes axes() const;
  /// The axis of a direction, where it has one.
  int axis(std::size_t k) const { return axis_[k]; }
  /// The same before they are rounded down.
  Vec3 real_coordinates(Vec3 p) const {
    const Vec3 at = p - origin_;
    return {dot(directions_[0].row, at), dot(directions_[1].row, at), dot(directions_[2].row, at)};
  }
  /// Sides of the box around a cell, along the axes of space [length].
  Vec3 extent() const;
  double cell_volume() const { return edges_[0][0] * edges_[1][1] * edges_[2][2]; }

  /// Calls f(y, z, first, last) for rows of cells, along the first direction, with all cells that have a
  /// point within `reach` of a box, given by its corners in cell coordinates, and few others. Coordinates go
  /// on beyond the period.
  template <class F>
  void for_each_row_near(Vec3 low, Vec3 high, double reach, const F& f) const;

 private:
  struct Interval {
    double low, high;
    double gap() const { return std::max({0.0, low, -high}); }
  };
  static Interval scaled(double by, Interval v) {
    return by < 0 ? Interval{by * v.high, by * v.low} : Interval{by * v.low, by * v.high};
  }
  struct Ends {
    double least, most;
  };
  static double cut_to(Ends ends, double u) {
    u = u < ends.least ? ends.least : u;
    return u > ends.most ? ends.most : u;
  }
  static std::int32_t floored_above(double u) {
    // Above 0, where to cut off is to round down.
    return static_cast<std::int32_t>(u + kFarthest) - static_cast<std::int32_t>(kFarthest);
  }
  /// Rounded down, within the cells that there are.
  [[gnu::always_inline]] std::int32_t cut(std::size_t k, double u) const {
    return floored_above(cut_to({directions_[k].least, directions_[k].most}, u));
  }
  static std::int32_t floored(double u) { return static_cast<std::int32_t>(std::floor(u)); }

  Vec3 origin_;
  bool right_angles_ = false;  ///< whether each row has one component: its axis, and how long it is
  std::array<int, 3> axis_{};
  std::array<double, 3> along_{};
  std::array<Direction, 3> directions_;
  static constexpr double kPieces = 1 << kHalvings;
  std::array<Ends, 3> pieces_{};  ///< of the coordinates of pieces
  /// Edges in a frame of right angles: row k holds the k-th component of the edges k, k + 1, ..
  std::array<std::array<double, 3>, 3> edges_{};
};

/// The difference of a point of a cell and one of the box is a sum of edges, of which the last alone has a
/// last component in the right-angled frame, the last two a second one. So the last coordinate bounds the gap
/// along the last component, both bound the one along the second, and so on: exactly in a cell with right
/// angles, else from below.
template <class F>
void CellLayout::for_each_row_near(Vec3 low, Vec3 high, double reach, const F& f) const {
  const auto between = [&](int k, std::int32_t cell) {
    return Interval{cell - high[k] - kMargin, cell + 1 - low[k] + kMargin};
  };
  const auto first_of = [&](int k, double left, Interval off) {
    return floored(low[k] - (left + off.high) / edges_[k][k] - kMargin);
  };
  const auto last_of = [&](int k, double left, Interval off) {
    return floored(high[k] + (left - off.low) / edges_[k][k] + kMargin);
  };
  const auto rest_of = [](double left, double gap) {
    return std::sqrt(std::max(left * left - gap * gap, 0.0));
  };
  const std::int32_t last_z = last_of(2, reach, {0, 0});
  for (std::int32_t z = first_of(2, reach, {0, 0}); z <= last_z; ++z) {
    const Interval dz = between(2, z), y_by_z = scaled(edges_[1][2], dz), x_by_z = scaled(edges_[0][2], dz);
    const double left_y = rest_of(reach, scaled(edges_[2][2], dz).gap());
    const std::int32_t last_y = last_of(1, left_y, y_by_z);
    for (std::int32_t y = first_of(1, left_y, y_by_z); y <= last_y; ++y) {
      const Interval dy = between(1, y), along = scaled(edges_[1][1], dy), x_by_y = scaled(edges_[0][1], dy);
      const double left_x = rest_of(left_y, Interval{along.low + y_by_z.low, along.high + y_by_z.high}.gap());
      const Interval off{x_by_y.low + x_by_z.low, x_by_y.high + x_by_z.high};
      const std::int32_t first = first_of(0, left_x, off), last = last_of(0, left_x, off);
      if (first <= last) f(y, z, first, last);
    }
  }
}

}  // namespace dch::detail
