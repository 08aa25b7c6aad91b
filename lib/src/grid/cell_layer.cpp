// SPDX-License-Identifier: MIT
#include "grid/cell_layer.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/metric.hpp"
#include "grid/cell_grid.hpp"
#include "leaves/rounding.hpp"

namespace dch::detail {
namespace {

/// Cells along a direction at most: 64 bits hold the keys then, and the coordinates in units of cells cut
/// into 2^16 are exact to a thousandth of a unit.
constexpr std::int64_t kMostCellsAlong = std::int64_t{1} << 20;

constexpr std::int32_t kAhead = 24;  ///< points whose positions, in no cache, are asked for before their turn

}  // namespace

void CellLayer::clear() {
  size_ = 0;
  first_.assign(1, 0);
  occupied_.clear();
  table_.clear();
  row_first_.clear();
  dense_ = true;
  count_ = {0, 0, 0};
}

bool CellLayer::sort(Span<const Vec3> positions, const std::vector<std::int32_t>* members, const Box& box,
                     const CellLayout& layout, Executor* executor) {
  clear();
  const std::size_t n = members != nullptr ? members->size() : positions.size();
  if (n == 0) return true;
  layout_ = layout;
  coordinates_.resize(n);
  with_metric(box, [&](const auto& metric) { find_coordinates(metric, positions, members, executor); });
  CellCoordinates low{0, 0, 0}, high;
  for (std::size_t k = 0; k < 3; ++k) high[k] = layout_[k].cells - 1;
  if (box.rank() < 3 || !CellNumbering::fits_dense_block(n, low, high)) find_corners(low, high);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t along = std::int64_t{high[k]} - low[k] + 1;
    if (std::max<std::int64_t>(along, layout_[k].cells) > kMostCellsAlong) return false;
    low_[k] = low[k];
    count_[k] = static_cast<std::int32_t>(along);
  }
  dense_ = CellNumbering::fits_dense_block(n, low, high);
  number_cells();
  next_.assign(first_.begin(), first_.end());
  id_.resize(n + kChunk);
  std::int32_t *const next = next_.data(), *const id = id_.data();
  for (std::size_t k = 0; k < n; ++k)
    id[next[cell_of_[k]]++] = members != nullptr ? (*members)[k] : static_cast<std::int32_t>(k);
  size_ = static_cast<std::int32_t>(n);
  return true;
}

template <class Metric>
void CellLayer::find_coordinates(const Metric& metric, Span<const Vec3> positions,
                                 const std::vector<std::int32_t>* members, Executor* executor) {
  for_ranges(executor, coordinates_.size(), [&](std::size_t begin, std::size_t end) {
    // Of their own, so that nothing is read again for fear that it was written to.
    const CellLayout layout = layout_;
    const Metric own_metric = metric;
    CellCoordinates* const to = coordinates_.data();
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = members != nullptr ? static_cast<std::size_t>((*members)[k]) : k;
      to[k] = layout.coordinates(own_metric.wrap(positions[i]));
    }
  });
}

/// Corners of the block of cells that hold all points.
void CellLayer::find_corners(CellCoordinates& low, CellCoordinates& high) const {
  low = high = coordinates_[0];
  for (const CellCoordinates& c : coordinates_)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], c[k]);
      high[k] = std::max(high[k], c[k]);
    }
}

std::int64_t CellLayer::key_of(const CellCoordinates& c) const {
  return (std::int64_t{c[2] - low_[2]} * count_[1] + (c[1] - low_[1])) * count_[0] + (c[0] - low_[0]);
}

/// Cell of each point, and where the points of each cell begin.
void CellLayer::number_cells() {
  cell_of_.resize(coordinates_.size());
  if (!dense_) find_occupied();
  const std::size_t cells = dense_
                                ? static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                                      static_cast<std::size_t>(count_[2])
                                : occupied_.size();
  first_.assign(cells + 1, 0);
  std::int32_t* const counts = first_.data() + 1;
  if (dense_) {
    const CellCoordinates low = low_, count = count_;
    std::int32_t* const cell_of = cell_of_.data();
    for (std::size_t k = 0; k < cell_of_.size(); ++k) {
      const CellCoordinates& c = coordinates_[k];
      const std::int32_t cell = ((c[2] - low[2]) * count[1] + (c[1] - low[1])) * count[0] + (c[0] - low[0]);
      cell_of[k] = cell;
      ++counts[cell];
    }
  } else {
    for (const std::int32_t cell : cell_of_) ++counts[cell];
  }
  count_points();
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
  while (size < 2 * coordinates_.size()) size *= 2;
  table_.assign(size, {-1, {}});
  slot_.resize(coordinates_.size());
  for (std::size_t k = 0; k < coordinates_.size(); ++k) {
    const std::int64_t key = key_of(coordinates_[k]);
    slot_[k] = slot_of(key);
    if (table_[slot_[k]].key >= 0) continue;
    table_[slot_[k]].key = key;
    occupied_.push_back(key);
  }
  std::sort(occupied_.begin(), occupied_.end());
  for (std::size_t cell = 0; cell < occupied_.size(); ++cell)
    table_[slot_of(occupied_[cell])].cells.begin = static_cast<std::int32_t>(cell);
  for (std::size_t k = 0; k < slot_.size(); ++k) cell_of_[k] = table_[slot_[k]].cells.begin;
  find_rows();
}

/// Where the occupied cells of each row are among all of them.
void CellLayer::find_rows() {
  const auto cells = static_cast<std::int32_t>(occupied_.size());
  if (CellNumbering::fits_dense_block(coordinates_.size(), {0, low_[1], low_[2]},
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

std::int32_t CellLayer::first_cell_of_share(int share, int shares) const {
  const auto found = std::lower_bound(first_.begin(), first_.end() - 1, share_begin(size(), share, shares));
  return static_cast<std::int32_t>(found - first_.begin());
}

/// For occupancy_, and where the points of each cell begin, given how many each of them has.
void CellLayer::count_points() {
  double squares = 0, occupied = 0;
  std::int32_t before = 0;
  for (std::int32_t& count : first_) {
    squares += static_cast<double>(count) * count;
    occupied += count > 0;
    before += count;
    count = before;
  }
  occupancy_ = {before / occupied, squares / before, dense_ ? 0.0 : 1.0};
}

CellCoordinates CellLayer::coordinates(std::int32_t cell) const {
  const std::int64_t key = dense_ ? cell : occupied_[cell], yz = key / count_[0];
  return {low_[0] + static_cast<std::int32_t>(key - yz * count_[0]),
          low_[1] + static_cast<std::int32_t>(yz % count_[1]),
          low_[2] + static_cast<std::int32_t>(yz / count_[1])};
}

void CellLayer::quantize(Span<const Vec3> positions, const Box& box, Vec3 origin, double unit,
                         const ParticleLabels& labels, Executor* executor) {
  const std::size_t room = static_cast<std::size_t>(size_) + kChunk;
  for (auto* axis : {&x_, &y_, &z_}) axis->resize(room);
  tag_.resize(labels.by == CutoffBy::one_cutoff ? 0 : room);
  with_metric(box, [&](const auto& metric) {
    for_ranges(executor, size_, [&](std::int32_t begin, std::int32_t end) {
      const auto own_metric = metric;
      std::int16_t *const x = x_.data(), *const y = y_.data(), *const z = z_.data();
      const std::int32_t* const id = id_.data();
      const double per_unit = 1 / unit;
      for (std::int32_t place = begin; place < end; ++place) {
        __builtin_prefetch(&positions[static_cast<std::size_t>(id[std::min(place + kAhead, end - 1)])]);
        const Vec3 at = own_metric.wrap(positions[static_cast<std::size_t>(id[place])]) - origin;
        x[place] = rounded(at.x * per_unit);
        y[place] = rounded(at.y * per_unit);
        z[place] = rounded(at.z * per_unit);
      }
    });
  });
  for (std::int32_t place = 0; place < size_ && labels.by == CutoffBy::radii; ++place)
    tag_[place] = rounded(labels.radii[id_[place]] / unit);
  for (std::int32_t place = 0; place < size_ && labels.by == CutoffBy::types; ++place)
    tag_[place] = static_cast<std::int16_t>(labels.types[id_[place]] % kKernelTypes);
}

void CellLayer::find_ghosts(std::int32_t first_ghost) {
  owned_.clear();
  if (first_ghost < 0) return;
  owned_.assign(static_cast<std::size_t>(cells()), 0);
  for (std::int32_t cell = 0; cell < cells(); ++cell)
    for (std::int32_t place = first_[cell]; place < first_[cell + 1]; ++place)
      owned_[cell] |= id_[place] < first_ghost;
}

std::size_t CellLayer::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  return bytes_of(coordinates_) + bytes_of(slot_) + bytes_of(cell_of_) + bytes_of(next_) + bytes_of(first_) +
         bytes_of(occupied_) + bytes_of(table_) + bytes_of(row_first_) + bytes_of(owned_) + 3 * bytes_of(x_) +
         bytes_of(tag_) + bytes_of(id_);
}

}  // namespace dch::detail
