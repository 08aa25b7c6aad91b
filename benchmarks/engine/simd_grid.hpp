// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "base/aligned_vector.hpp"
#include "frozen/frozen_kernels.hpp"

namespace dch::bench {

/// The best neighbor list that we know how to make from a grid of cells with the kernels that the hierarchy's
/// lists use: the baseline that keeps us honest. Points are put in the order of their cells as 16-bit
/// integers, the half stencil around a cell is copied side by side, thinned to what is near the cell's own
/// points, then to what is near eight of them, and tested. Built from scratch for every list.
///
/// Orthorhombic and open boxes, one cutoff; periodic boxes at least three list radii wide.
class SimdGrid {
 public:
  enum class Cells {
    dense,  ///< an array over the whole box
    hash    ///< a table of occupied cells, for points that fill little of the box
  };
  /// @param cell_width [length]; to be swept by the caller for the least time.
  SimdGrid(double radius, double cell_width, Cells cells)
      : radius_(radius), width_(cell_width), kind_(cells) {}

  /// Unsorted half list of all pairs within the radius that are not excluded.
  /// @throws std::invalid_argument if the periodic box is too narrow for cells of this width.
  void list(Span<const Vec3> positions, const Box& box, const Exclusions& exclusions, NeighborList& out);
  /// Held now.
  std::size_t memory_bytes() const;

 private:
  using Cell = std::array<std::int32_t, 3>;
  struct Run {
    std::int32_t begin = 0, end = 0;
  };
  struct Candidates {
    detail::AlignedVector<std::int16_t> x, y, z;
    detail::AlignedVector<std::int32_t> id;
    void make_room(std::size_t count);
    detail::Candidates at(std::size_t k) { return {x.data() + k, y.data() + k, z.data() + k, id.data() + k}; }
  };

  void lay_out(Span<const Vec3> positions, const Box& box);
  void make_stencil();
  void sort_points(Span<const Vec3> positions);
  void number_cells();
  void find_occupied();
  std::size_t slot_of(std::int64_t key) const;
  Run points_of(std::int64_t first, std::int64_t last) const;
  void rows_of_cell(Run own, const Cell& at, Span<const Vec3> positions, const Box& box, NeighborList& out);
  void append_row(const Cell& at, std::int32_t dy, std::int32_t dz, std::int32_t first, std::int32_t last);
  void append(Run run, const std::array<std::int16_t, 3>& shift);
  void rows_of_block(Run block, std::int32_t before, Span<const Vec3> positions, const Box& box,
                     NeighborList& out);
  std::int64_t key_of(const Cell& at) const {
    return (static_cast<std::int64_t>(at[2]) * counts_[1] + at[1]) * counts_[0] + at[0];
  }

  double radius_, width_;
  Cells kind_;
  std::array<bool, 3> periodic_{};
  Vec3 low_, length_, cell_;
  std::array<std::int32_t, 3> counts_{};
  std::array<std::int32_t, 3> reach_{};  ///< cells that the stencil extends
  double unit_ = 1;
  std::int16_t in_ = 0, out_ = 0;

  struct Row {
    std::int32_t dy, dz, dx;  ///< cells x - dx .. x + dx of a row
  };
  std::vector<Row> stencil_;    ///< rows after the own one
  std::int32_t own_reach_ = 0;  ///< cells after the own one in its row

  std::vector<std::int64_t> key_;       ///< by point
  std::vector<std::int32_t> cell_of_;   ///< by point
  std::vector<std::int32_t> first_;     ///< by cell (dense) or occupied cell (hash): where its points begin
  std::vector<std::int64_t> occupied_;  ///< keys of occupied cells (hash)
  struct Slot {
    std::int64_t key;
    std::int32_t cell;
  };
  std::vector<Slot> table_;  ///< open addressing
  Candidates sorted_, around_, near_;
  std::int32_t count_ = 0;  ///< of around_
  std::vector<std::int32_t> next_;
  std::vector<std::uint32_t> mask_;
  std::vector<Unsettled> unsettled_;
  const FrozenKernels* kernels_ = nullptr;
  const Exclusions* exclusions_ = nullptr;  ///< of the list being made; null if there are none
};

}  // namespace dch::bench
