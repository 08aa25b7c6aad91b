// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

#include "base/aligned_vector.hpp"
#include "hierarchy/structure.hpp"

namespace dch::detail {

/// Points by the cells of a grid that is kept up as they come and go. A cell is a cache line with the
/// coordinates and the ids of six points, and further lines where it holds more. Coordinates are 16-bit
/// integers, 4096 a cell, and start anew after 16 cells: a question looks at cells less than eight apart, so
/// differences tell distances up to rounding, which double decides, and the upper four bits tell which cell a
/// point is of. Lines stand in the order of the cells where so few cells hold all points, else in a hash
/// table, in which several cells may share a line.
///
/// A cell holds 24 points. One that was to hold more is overfull: some of its points are not in the grid, and
/// questions that look at it have no answer.
///
/// For boxes whose axes are at right angles, and coordinates up to 2^30 cells.
class PointCells {
 public:
  static constexpr int kPoints = 6;          ///< of a line
  static constexpr int kMostLines = 4;       ///< of a cell
  static constexpr int kBits = 12;           ///< of a coordinate in its cell
  static constexpr int kUnits = 1 << kBits;  ///< along a cell
  static constexpr int kMostAlong = 7;       ///< cells that a question looks at along an axis
  /// How far the distance of a point and a position along an axis, by their coordinates in cells, may be from
  /// that which Box::distance2() takes, in cells: with coordinates up to 2^30 cells, those of both are off by
  /// 2^-21 at most, four roundings each, and the difference that the box takes by 2^-22. What is left is for
  /// roundings that do not grow with coordinates.
  static constexpr double kRounding = 0x1p-19;
  /// Distances by integers are this far off at most, in units: along each axis by one and by rounding.
  static constexpr double kSteps = 1.75;

  struct alignas(64) Line {
    std::uint16_t at[3][kPoints];
    std::int32_t id[kPoints];  ///< kNone for none
    std::int32_t next;         ///< of the cell, kNone or kOverfull
  };
  static constexpr std::int32_t kOverfull = -2;

  /// Takes all points, in cells of a width or somewhat more. Is empty after points or boxes that do not fit.
  void make(const Structure& structure, double width);
  /// In cells that hold two to three points in the mean where most points are.
  void make(const Structure& structure);
  void clear();
  bool empty() const { return !is_made_; }
  double least_width() const { return least_width_; }  ///< of a cell [length]
  double most_width() const { return most_width_; }    ///< [length]

  // While it is not empty; all ids of points are known by grow().
  void grow(std::size_t ids);
  void insert(std::int32_t id, Vec3 at);
  void remove(std::int32_t id);  ///< if it is there
  /// The lines that a point leaves or comes to are on the way from memory then.
  void prefetch(std::int32_t id, Vec3 at) const;

  /// A place in cells, in the image that the grid holds; false if it is too far out.
  bool locate(Vec3 at, std::array<double, 3>& cells) const;
  double width(std::size_t axis) const { return axes_[axis].width; }
  const Line& line(std::int32_t k) const { return lines_[static_cast<std::size_t>(k)]; }

  /// A cell along one axis, as a question sees it.
  struct Coordinate {
    std::uint64_t part = 0;   ///< of the sum that tells the line
    std::uint16_t query = 0;  ///< where the question is, in units, seen from points of this cell
    std::uint16_t cell = 0;   ///< the upper four bits of their coordinates
  };
  /// @param units of the question, from the grid's origin on
  Coordinate coordinate(std::size_t axis, std::int64_t cell, std::int64_t units) const;
  std::int32_t line_of(std::uint64_t parts) const { return static_cast<std::int32_t>(parts >> shift_); }

 private:
  struct Axis {
    double origin = 0;       ///< [length]
    double length = 0;       ///< the period, or how far points go [length]
    double width = 0;        ///< of a cell [length]
    double per_length = 0;   ///< cells
    std::int64_t cells = 0;  ///< of a period; 0 of other axes
    std::int64_t rows = 0;   ///< of lines; 0 of a hash table
    std::uint64_t stride = 0;
  };
  struct Place {
    std::int32_t line = kNone;  ///< the first one of the cell
    std::array<std::uint16_t, 3> units{};
  };
  bool place(Vec3 at, Place& place) const;
  bool choose_axes(const Structure& structure, double width);
  void line_by_rows(std::size_t lines);
  void line_by_table(std::size_t points);
  bool fit_widths(const Box& box);
  void take_all(const Structure& structure);
  double mean_company() const;
  static std::uint64_t part(const Axis& axis, std::int64_t cell);
  std::int32_t line_with_room(std::int32_t line);
  std::int32_t new_line();

  bool is_made_ = false;
  double least_width_ = 0, most_width_ = 0;
  std::array<Axis, 3> axes_;
  unsigned shift_ = 0;
  std::size_t first_lines_ = 0;  ///< of cells; those that follow are further ones
  AlignedVector<Line> lines_;
  std::int32_t spare_ = kNone;            ///< first of those that no cell has, by `next`
  std::vector<std::int32_t> line_of_id_;  ///< the first one of its cell
  std::size_t most_ids_ = 0;
};

}  // namespace dch::detail
