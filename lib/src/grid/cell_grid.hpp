// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

#include "grid/cell_layout.hpp"

namespace dch::detail {

/// Numbers the occupied cells of a grid: by position in a dense block where that is small, else by a hash
/// table, so that memory is O(points) however far apart they lie.
class CellNumbering {
 public:
  static constexpr std::int32_t kNone = -1;

  /// Whether the cells with coordinates within [low, high] are few enough for so many points, and for 32-bit
  /// numbers, to have one each, occupied or not.
  static bool fits_dense_block(std::size_t points, CellCoordinates low, CellCoordinates high);

  /// Forgets all cells.
  void clear();
  /// The same; those to come have coordinates within [low, high].
  void reset(std::size_t points, CellCoordinates low, CellCoordinates high);
  /// Number of a cell, which exists from now on.
  std::int32_t insert(CellCoordinates c);
  /// Number of a cell, or kNone if it was never inserted (a dense block has all of its cells).
  std::int32_t find(CellCoordinates c) const;
  std::int32_t count() const { return static_cast<std::int32_t>(cells_.size()); }
  CellCoordinates coordinates(std::int32_t cell) const { return cells_[cell]; }
  std::size_t memory_bytes() const;

 private:
  std::size_t bucket_of(CellCoordinates c) const;

  bool dense_ = true;
  CellCoordinates low_{}, high_{};
  std::vector<CellCoordinates> cells_;
  std::vector<std::int32_t> buckets_;  ///< cell numbers; at most half of them in use; empty if dense
};

/// Points of a periodic or open space sorted into cells of the reduced lattice.
class CellGrid {
 public:
  /// Cells are at least `width` wide between opposite faces (a box narrower than that has one cell there).
  /// `wrapped` are positions that Box::wrap has put into the cell.
  void build(Span<const Vec3> wrapped, const Box& box, double width);
  void clear();  ///< takes no memory

  std::int32_t cells() const { return numbering_.count(); }
  /// The points of a cell: places first_place(cell) up to first_place(cell + 1).
  std::int32_t first_place(std::int32_t cell) const { return first_[cell]; }
  std::int32_t point(std::int32_t place) const { return point_[place]; }
  Vec3 position(std::int32_t place) const { return position_[place]; }

  /// Whether different offsets of at most `reach` cells along each axis always lead to different cells, so
  /// that a pair of cells determines which images of their points can be near.
  bool separates_images(int reach) const;

  /// The cell at an offset from another one, or CellNumbering::kNone, and in `shift` the lattice vector that
  /// takes its points to that place.
  std::int32_t neighbor(std::int32_t cell, CellCoordinates offset, Vec3& shift) const;

  std::size_t memory_bytes() const;

 private:
  CellLayout layout_;
  CellNumbering numbering_;
  std::vector<CellCoordinates> coordinates_;  ///< by point; scratch
  std::vector<std::int32_t> cell_of_;         ///< by point; scratch
  std::vector<std::int32_t> first_{0};        ///< first place of each cell
  std::vector<std::int32_t> point_;           ///< by place
  std::vector<Vec3> position_;                ///< by place
};

}  // namespace dch::detail
