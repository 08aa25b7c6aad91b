// SPDX-License-Identifier: MIT
#include "grid/cell_layer.hpp"

#include <algorithm>
#include <utility>

#include <dch/base/index_count.hpp>

#include "grid/cell_grid.hpp"

namespace dch::detail {
namespace {

/// Cells along a direction at most: 64 bits hold the keys then, and the coordinates in units of cells cut
/// into 2^16 are exact to a thousandth of a unit.
constexpr std::int64_t kMaxCellsAlong = std::int64_t{1} << 20;

/// Pieces of cells are not many more than points, so that arrays of them are no longer than those of points.
constexpr double kPiecesPerPoint = 2;

constexpr CellCurve kCurves[CellLayout::kHalvings + 1] = {CellCurve(0), CellCurve(1), CellCurve(2)};
static_assert(CellLayout::kHalvings == CellCurve::kBits);

/// Points that are looked at together, while they are in the nearest cache.
constexpr std::size_t kLayerPiece = 256;

}  // namespace

void CellLayer::clear() {
  clear_cells();
  number_.clear();
  first_.assign(1, 0);
}

/// Those of all points; none of the arrays by point or piece, which are about to be filled again.
void CellLayer::clear_cells() {
  size_ = 0;
  curve_ = kCurves[0];
  dense_ = true;
  count_ = {0, 0, 0};
  occupied_.clear();
  table_.clear();
  row_first_.clear();
}

bool CellLayer::start(std::size_t n, const Box& box, const CellLayout& layout, const CellRounding& rounding) {
  clear_cells();
  layout_ = layout;
  CellCoordinates high;
  std::size_t cells = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    if (layout[k].cells > kMaxCellsAlong) {
      clear();
      return false;
    }
    high[k] = layout[k].cells - 1;
    cells *= static_cast<std::size_t>(layout[k].cells);
  }
  block_known_ = box.rank() == 3 && CellNumbering::fits_dense_block(n, {0, 0, 0}, high);
  rounding_ = {};
  piece_.resize(block_known_ ? 0 : n);
  number_.resize(n);
  rounded_.resize(rounding.unit > 0 ? n : 0);
  rounding_ = rounding;
  if (!block_known_) return true;
  low_ = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) count_[k] = layout[k].cells;
  halve_cells(cells);
  return true;
}

void CellLayer::take(const CellBins& bins, Span<const Vec3> positions, std::size_t first) {
  const std::array<int, 3> axes{bins.axis(0), bins.axis(1), bins.axis(2)};
  std::array<CellCoordinates, kLayerPiece> pieces;
  std::array<RoundedPoint, kLayerPiece> unused;
  for (std::size_t begin = 0; begin < positions.size(); begin += kLayerPiece) {
    const std::size_t count = std::min(kLayerPiece, positions.size() - begin), at = first + begin;
    bins.find({positions.data() + begin, count}, pieces.data(),
              rounded_.empty() ? unused.data() : rounded_.data() + at);
    if (block_known_) {
      number_pieces(pieces.data(), count, axes, number_.data() + at);
      continue;
    }
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t direction = 0; direction < 3; ++direction)
        piece_[at + k][direction] = pieces[k][static_cast<std::size_t>(axes[direction])];
  }
}

bool CellLayer::sort(const std::vector<std::int32_t>* members) {
  const std::size_t n = number_.size();
  if (n == 0 || (!block_known_ && !find_block())) {
    clear();
    return n == 0;
  }
  count_points();
  put_in_cells(members);
  size_ = static_cast<std::int32_t>(n);
  return true;
}

/// Of the block of cells that hold all points: its corners, and the numbers of the pieces of cells in it.
/// Returns false if it is too long.
bool CellLayer::find_block() {
  CellCoordinates low = piece_[0], high = piece_[0];
  for (const CellCoordinates& c : piece_)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], c[k]);
      high[k] = std::max(high[k], c[k]);
    }
  std::size_t cells = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = cell_of(low[k]);
    high[k] = cell_of(high[k]);
    const std::int64_t along = std::int64_t{high[k]} - low[k] + 1;
    if (along > kMaxCellsAlong) return false;
    low_[k] = low[k];
    count_[k] = static_cast<std::int32_t>(along);
    cells *= static_cast<std::size_t>(along);
  }
  dense_ = CellNumbering::fits_dense_block(piece_.size(), low, high);
  if (!dense_) {
    find_occupied();
    return true;
  }
  halve_cells(cells);
  number_pieces(piece_.data(), piece_.size(), {0, 1, 2}, number_.data());
  return true;
}

/// Numbers of pieces in a dense block.
/// @param axes where their coordinates along each direction stand
void CellLayer::number_pieces(const CellCoordinates* pieces, std::size_t count, std::array<int, 3> axes,
                              std::int32_t* to) const {
  // Of their own, so that nothing is read again for fear that it was written to.
  const CellCurve curve = curve_;
  // In 64 bits, where no product overflows, however far from the origin the block lies.
  const std::int64_t row = count_[0], plane = row * count_[1];
  const std::int64_t first = low_[2] * plane + low_[1] * row + low_[0];
  const auto [x, y, z] = axes;
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t at_x = pieces[k][x], at_y = pieces[k][y], at_z = pieces[k][z];
    const std::int64_t cell = cell_of(at_z) * plane + cell_of(at_y) * row + cell_of(at_x) - first;
    to[k] = static_cast<std::int32_t>(cell) << curve.bits() | curve(at_x, at_y, at_z);
  }
}

/// Cuts cells into pieces, of which there are to be so many cells' at most.
void CellLayer::halve_cells(std::size_t cells) {
  const double most = std::min(kPiecesPerPoint * static_cast<double>(number_.size()), double{kMaxIndexCount});
  int halvings = CellLayout::kHalvings;
  while (halvings > 0 && static_cast<double>(cells << (3 * halvings)) > most) --halvings;
  curve_ = kCurves[halvings];
  first_.resize((cells << curve_.bits()) + 1);
}

/// Ids and, if they are rounded, coordinates. Leaves at each piece's place in first_ where its points begin.
void CellLayer::put_in_cells(const std::vector<std::int32_t>* members) {
  const std::size_t n = number_.size(), room = n + kChunk;
  id_.resize(room);
  for (auto* axis : {&x_, &y_, &z_}) axis->resize(room);
  std::int32_t *const next = first_.data() + 1, *const id = id_.data();
  const std::int32_t* const number = number_.data();
  const auto id_of = [&](std::size_t k) {
    return members != nullptr ? (*members)[k] : static_cast<std::int32_t>(k);
  };
  if (rounded_.empty()) {
    for (std::size_t k = 0; k < n; ++k) id[next[number[k]]++] = id_of(k);
    return;
  }
  const RoundedPoint* const from = rounded_.data();
  std::int16_t *const x = x_.data(), *const y = y_.data(), *const z = z_.data();
  for (std::size_t k = 0; k < n; ++k) {
    const std::int32_t to = next[number[k]]++;
    id[to] = id_of(k);
    x[to] = from[k][0];
    y[to] = from[k][1];
    z[to] = from[k][2];
  }
}

std::int32_t CellLayer::first_cell_of_share(int share, int shares) const {
  const auto found = std::lower_bound(first_.begin(), first_.end() - 1, share_begin(size(), share, shares));
  // The first cell that begins there or later: its pieces before the one found hold no points.
  return static_cast<std::int32_t>((found - first_.begin() + (1 << curve_.bits()) - 1) >> curve_.bits());
}

/// For occupancy_, and where the points of each piece begin: one place farther on, so that put_in_cells()
/// moves it to where it belongs.
void CellLayer::count_points() {
  std::fill(first_.begin(), first_.end(), 0);
  std::int32_t* const counts = first_.data() + 1;
  for (const std::int32_t number : number_) ++counts[number];
  double squares = 0, occupied = 0;
  std::int32_t before = 0;
  const std::int32_t pieces = 1 << curve_.bits();
  for (std::int32_t* piece = counts; piece != counts + first_.size() - 1; piece += pieces) {
    const std::int32_t before_cell = before;
    for (std::int32_t k = 0; k < pieces; ++k) before += std::exchange(piece[k], before);
    const double count = before - before_cell;
    squares += count * count;
    occupied += count > 0;
  }
  occupancy_ = {before / occupied, squares / before, dense_ ? 0.0 : 1.0};
}

CellCoordinates CellLayer::coordinates(std::int32_t cell) const {
  const std::int64_t key = dense_ ? cell : occupied_[cell], yz = key / count_[0];
  return {low_[0] + static_cast<std::int32_t>(key - yz * count_[0]),
          low_[1] + static_cast<std::int32_t>(yz % count_[1]),
          low_[2] + static_cast<std::int32_t>(yz / count_[1])};
}

std::size_t CellLayer::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  return bytes_of(piece_) + bytes_of(rounded_) + bytes_of(slot_) + bytes_of(number_) + bytes_of(first_) +
         bytes_of(occupied_) + bytes_of(table_) + bytes_of(row_first_) + bytes_of(owned_) + 3 * bytes_of(x_) +
         bytes_of(tag_) + bytes_of(id_);
}

}  // namespace dch::detail
