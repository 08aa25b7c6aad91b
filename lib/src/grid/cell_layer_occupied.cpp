// SPDX-License-Identifier: MIT
//
// Cells of a layer that are too many for an array: the occupied ones, by their keys.
#include <algorithm>
#include <numeric>

#include "grid/cell_grid.hpp"
#include "grid/cell_layer.hpp"

namespace dch::detail {

/// Of the cell of a piece.
std::int64_t CellLayer::key_of(const CellCoordinates& piece) const {
  return (std::int64_t{cell_of(piece[2]) - low_[2]} * count_[1] + (cell_of(piece[1]) - low_[1])) * count_[0] +
         (cell_of(piece[0]) - low_[0]);
}

/// Slot of a key in the table, or the free one where it belongs.
std::size_t CellLayer::slot_of(std::int64_t key) const {
  const std::size_t mask = table_.size() - 1;
  std::size_t slot = (static_cast<std::uint64_t>(key) * 0x9E3779B97F4A7C15u >> 20) & mask;
  while (table_[slot].key != key && table_[slot].key >= 0) slot = (slot + 1) & mask;
  return slot;
}

/// Numbers the occupied cells by their keys, so that the points of neighbors in a row lie side by side.
void CellLayer::find_occupied() {
  std::size_t size = 64;
  while (size < 2 * piece_.size()) size *= 2;
  table_.assign(size, {-1, {}});
  slot_.resize(piece_.size());
  for (std::size_t k = 0; k < piece_.size(); ++k) {
    const std::int64_t key = key_of(piece_[k]);
    slot_[k] = slot_of(key);
    if (table_[slot_[k]].key >= 0) continue;
    table_[slot_[k]].key = key;
    occupied_.push_back(key);
  }
  std::sort(occupied_.begin(), occupied_.end());
  for (std::size_t cell = 0; cell < occupied_.size(); ++cell)
    table_[slot_of(occupied_[cell])].cells.begin = static_cast<std::int32_t>(cell);
  halve_cells(occupied_.size());
  for (std::size_t k = 0; k < slot_.size(); ++k) {
    const CellCoordinates& piece = piece_[k];
    number_[k] = table_[slot_[k]].cells.begin << curve_.bits() | curve_(piece[0], piece[1], piece[2]);
  }
  find_rows();
}

/// Where the occupied cells of each row are among all of them.
void CellLayer::find_rows() {
  const auto cells = static_cast<std::int32_t>(occupied_.size());
  if (CellNumbering::fits_dense_block(piece_.size(), {0, low_[1], low_[2]},
                                      {0, low_[1] + count_[1] - 1, low_[2] + count_[2] - 1})) {
    row_first_.assign(static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(count_[2]) + 1, 0);
    for (const std::int64_t key : occupied_) ++row_first_[key / count_[0] + 1];
    std::partial_sum(row_first_.begin(), row_first_.end(), row_first_.begin());
    return;
  }
  std::size_t size = 64;
  while (size < 2 * occupied_.size()) size *= 2;
  table_.assign(size, {-1, {}});
  for (std::int32_t begin = 0, end = 0; begin < cells; begin = end) {
    const std::int64_t row = occupied_[begin] / count_[0];
    while (end < cells && occupied_[end] < (row + 1) * count_[0]) ++end;
    table_[slot_of(row)] = {row, {begin, end}};
  }
}

/// Numbers of the occupied cells first .. last of a row.
CellLayer::Run CellLayer::occupied_between(std::int64_t row, std::int32_t first, std::int32_t last) const {
  const Run all = cells_of_row(row);
  const std::int64_t key = row * count_[0];
  const auto from = std::lower_bound(occupied_.begin() + all.begin, occupied_.begin() + all.end, key + first);
  Run cells{static_cast<std::int32_t>(from - occupied_.begin()), 0};
  cells.end = cells.begin;
  while (cells.end < all.end && occupied_[cells.end] <= key + last) ++cells.end;
  return cells;
}

}  // namespace dch::detail
