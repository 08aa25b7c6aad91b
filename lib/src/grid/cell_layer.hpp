// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

#include "base/aligned_vector.hpp"
#include "grid/cell_bins.hpp"
#include "grid/cell_curve.hpp"
#include "grid/cell_layout.hpp"
#include "grid/rounded_particles.hpp"
#include "leaves/labelled_leaves.hpp"
#include "simd/list_kernels.hpp"

namespace dch::detail {

/// How many points cells hold, of those that hold any.
struct Occupancy {
  double mean = 1;      ///< of a cell
  double of_point = 1;  ///< in the cell of a point, itself counted: more than the mean where points crowd
  double sparse = 0;    ///< share of the points whose cells are not in an array of all cells
  /// How uneven it is: 1 if all cells hold as many.
  double spread() const { return of_point / mean; }
};

/// Points sorted into cells of the reduced lattice, those of a row of cells behind each other, so that runs
/// of cells are runs of points; within a cell along a curve, so that points next to each other are close
/// together. Coordinates are 16-bit integers that wrap, since only differences of points near each other are
/// taken.
class CellLayer {
 public:
  /// Points of cells that lie side by side: places [begin, end).
  struct Run {
    std::int32_t begin = 0, end = 0;
    std::int32_t size() const { return end - begin; }
  };

  /// Begins anew: `n` points are to be taken, then sorted.
  /// @param rounding that quantize() will most likely be asked for: positions are in registers here
  /// @return false, with no points in it, if there are too many cells for any points
  bool start(std::size_t n, const Box& box, const CellLayout& layout, const CellRounding& rounding);
  /// Takes points from the `first` one on. Each thread may take others.
  /// @param bins of the box, the layout and the rounding
  void take(const CellBins& bins, Span<const Vec3> positions, std::size_t first);
  /// Sorts the points into cells, when all have been taken.
  /// @param members whose points they are; those of all, in order, if it is null
  /// @return false, with no points in it, if they lie farther apart than cells can be told apart
  bool sort(const std::vector<std::int32_t>* members);
  void clear();

  /// Rounds the coordinates, and the radii if cutoffs go by them.
  void quantize(Span<const Vec3> positions, const Box& box, const CellRounding& rounding,
                const ParticleLabels& labels, Executor* executor);
  /// The same from particles that have been rounded for all layers.
  void quantize(const RoundedParticles& rounded, Executor* executor);
  /// Notes which cells hold none but ghosts.
  void find_ghosts(std::int32_t first_ghost);

  const CellLayout& layout() const { return layout_; }
  const CellRounding& rounding() const {
    return rounding_;
  }  ///< of the coordinates; unit 0 before quantize()
  std::int32_t size() const { return size_; }
  /// Cells, in a dense block with the empty ones.
  std::int32_t cells() const { return static_cast<std::int32_t>((first_.size() - 1) >> curve_.bits()); }
  /// The first cell of the k-th of `shares` parts with about as many points each.
  std::int32_t first_cell_of_share(int share, int shares) const;
  const Occupancy& occupancy() const { return occupancy_; }
  Run points_of(std::int32_t cell) const { return {begin_of(cell), begin_of(cell + 1)}; }
  CellCoordinates coordinates(std::int32_t cell) const;
  /// Whether the next `more` cells of its row, within the period, have the next numbers.
  bool are_in_row(std::int32_t cell, std::int32_t more) const {
    return dense_ && cell % count_[0] + more < count_[0];
  }
  /// Whether a point of the cell is not a ghost.
  bool is_owned(std::int32_t cell) const { return owned_.empty() || owned_[cell] != 0; }

  /// Calls f(run) for the points of cells first .. last of a row, which along open directions may lie beyond
  /// all points; `only_owned`: those of cells with a point that is not a ghost, cell by cell.
  template <class F>
  void for_each_run(std::int32_t first, std::int32_t last, std::int32_t y, std::int32_t z, bool only_owned,
                    const F& f) const;

  /// The points from a place on; they can be read kChunk beyond the last one.
  Candidates at(std::int32_t place) {
    return {x_.data() + place, y_.data() + place, z_.data() + place, id_.data() + place,
            tag_.empty() ? nullptr : tag_.data() + place};
  }
  std::size_t memory_bytes() const;

 private:
  void round_coordinates(Span<const Vec3> positions, const Box& box, const CellRounding& rounding,
                         Executor* executor);
  std::int32_t begin_of(std::int32_t cell) const {
    return first_[static_cast<std::size_t>(cell) << curve_.bits()];
  }
  void clear_cells();
  bool find_block();
  void number_pieces(const CellCoordinates* pieces, std::size_t count, std::array<int, 3> axes,
                     std::int32_t* to) const;
  void halve_cells(std::size_t cells);
  void count_points();
  void put_in_cells(const std::vector<std::int32_t>* members);
  std::int64_t key_of(const CellCoordinates& piece) const;
  void find_occupied();
  std::size_t slot_of(std::int64_t key) const;
  void find_rows();
  Run cells_of_row(std::int64_t row) const {
    if (!row_first_.empty()) return {row_first_[row], row_first_[row + 1]};
    return table_[slot_of(row)].cells;
  }
  Run occupied_between(std::int64_t row, std::int32_t first, std::int32_t last) const;

  CellLayout layout_;
  CellCoordinates low_{}, count_{};  ///< of the block that holds all cells
  bool block_known_ = false;         ///< whether the block is that of all cells of the box, before any point
  bool dense_ = true;                ///< whether each cell of the block has a number, its key
  CellCurve curve_{0};               ///< the order of the pieces of a cell
  std::vector<CellCoordinates> piece_;  ///< by point, unless the block is known: its piece; scratch
  CellRounding rounding_;               ///< that x_, y_ and z_ have
  std::vector<RoundedPoint> rounded_;   ///< by point, unless unit is 0; scratch
  std::vector<std::size_t> slot_;       ///< by point, unless dense; scratch
  std::vector<std::int32_t> number_;    ///< by point: number of its piece; scratch
  std::vector<std::int32_t> first_{0};  ///< by piece, cell by cell: where its points begin
  std::vector<std::int64_t> occupied_;  ///< keys of the cells, ascending, unless dense
  struct Slot {
    std::int64_t key;
    Run cells;
  };
  /// Open addressing. Of cells, while they are numbered, then of rows of cells with the numbers of theirs,
  /// unless row_first_ says them.
  std::vector<Slot> table_;
  std::vector<std::int32_t> row_first_;  ///< by row: its first occupied cell; empty if rows are too many
  Occupancy occupancy_;
  std::int32_t size_ = 0;
  std::vector<std::uint8_t> owned_;  ///< by cell; empty if there are no ghosts
  AlignedVector<std::int16_t> x_, y_, z_, tag_;
  AlignedVector<std::int32_t> id_;  ///< by place: whose point it is
};

template <class F>
void CellLayer::for_each_run(std::int32_t first, std::int32_t last, std::int32_t y, std::int32_t z,
                             bool only_owned, const F& f) const {
  const std::int32_t row_y = y - low_[1], row_z = z - low_[2];
  if (row_y < 0 || row_y >= count_[1] || row_z < 0 || row_z >= count_[2]) return;
  first = std::max(first - low_[0], 0);
  last = std::min(last - low_[0], count_[0] - 1);
  if (first > last) return;
  const std::int64_t row = std::int64_t{row_z} * count_[1] + row_y;
  const auto begin = static_cast<std::int32_t>(row * count_[0]);
  const Run cells = dense_ ? Run{begin + first, begin + last + 1} : occupied_between(row, first, last);
  if (!only_owned) {
    if (cells.begin < cells.end) f(Run{begin_of(cells.begin), begin_of(cells.end)});
    return;
  }
  for (std::int32_t cell = cells.begin; cell < cells.end; ++cell)
    if (is_owned(cell)) f(points_of(cell));
}

}  // namespace dch::detail
