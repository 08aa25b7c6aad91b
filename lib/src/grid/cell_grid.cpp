// SPDX-License-Identifier: MIT
#include "grid/cell_grid.hpp"

#include <algorithm>
#include <numeric>

#include <dch/base/index_count.hpp>

namespace dch::detail {
namespace {

/// A dense block may have this many cells for each point.
constexpr double kDenseCellsPerPoint = 4;

}  // namespace

void CellNumbering::clear() {
  dense_ = true;
  low_ = {1, 1, 1};
  high_ = {0, 0, 0};
  cells_.clear();
  buckets_.clear();
}

bool CellNumbering::fits_dense_block(std::size_t points, CellCoordinates low, CellCoordinates high) {
  double block = 1;
  for (std::size_t k = 0; k < 3; ++k) block *= static_cast<double>(high[k]) - low[k] + 1;
  return block <= std::min(kDenseCellsPerPoint * static_cast<double>(points), double{kMaxIndexCount});
}

void CellNumbering::reset(std::size_t points, CellCoordinates low, CellCoordinates high) {
  low_ = low;
  high_ = high;
  dense_ = fits_dense_block(points, low, high);
  cells_.clear();
  buckets_.clear();
  if (dense_) {
    CellCoordinates c;
    for (c[2] = low[2]; c[2] <= high[2]; ++c[2]) {
      for (c[1] = low[1]; c[1] <= high[1]; ++c[1]) {
        for (c[0] = low[0]; c[0] <= high[0]; ++c[0]) cells_.push_back(c);
      }
    }
    return;
  }
  std::size_t size = 16;
  while (size < 2 * points) size *= 2;
  buckets_.assign(size, kNone);
}

std::size_t CellNumbering::bucket_of(CellCoordinates c) const {
  std::uint64_t hash = static_cast<std::uint32_t>(c[0]) * 0x9e3779b97f4a7c15u;
  hash = (hash ^ (hash >> 32) ^ static_cast<std::uint32_t>(c[1])) * 0xc2b2ae3d27d4eb4fu;
  hash = (hash ^ (hash >> 29) ^ static_cast<std::uint32_t>(c[2])) * 0x165667b19e3779f9u;
  const std::size_t mask = buckets_.size() - 1;
  std::size_t bucket = (hash ^ (hash >> 32)) & mask;
  while (buckets_[bucket] != kNone && cells_[buckets_[bucket]] != c) bucket = (bucket + 1) & mask;
  return bucket;
}

std::int32_t CellNumbering::insert(CellCoordinates c) {
  if (dense_) return find(c);
  std::int32_t& cell = buckets_[bucket_of(c)];
  if (cell == kNone) {
    cell = count();
    cells_.push_back(c);
  }
  return cell;
}

std::int32_t CellNumbering::find(CellCoordinates c) const {
  if (!dense_) return buckets_[bucket_of(c)];
  std::int32_t cell = 0;
  for (const std::size_t k : {2u, 1u, 0u}) {
    if (c[k] < low_[k] || c[k] > high_[k]) return kNone;
    cell = cell * (high_[k] - low_[k] + 1) + (c[k] - low_[k]);
  }
  return cell;
}

std::size_t CellNumbering::memory_bytes() const {
  return cells_.capacity() * sizeof(CellCoordinates) + buckets_.capacity() * sizeof(std::int32_t);
}

void CellGrid::clear() {
  position_.clear();
  point_.clear();
  first_.assign(1, 0);
  numbering_.clear();
}

void CellGrid::build(Span<const Vec3> wrapped, const Box& box, double width) {
  clear();
  const std::size_t n = wrapped.size();
  if (n == 0) return;
  layout_ = CellLayout(wrapped, box, width);

  coordinates_.resize(n);
  for (std::size_t i = 0; i < n; ++i) coordinates_[i] = layout_.coordinates(wrapped[i]);
  CellCoordinates low = coordinates_[0], high = coordinates_[0];
  for (const CellCoordinates& c : coordinates_) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], c[k]);
      high[k] = std::max(high[k], c[k]);
    }
  }
  numbering_.reset(n, low, high);
  cell_of_.resize(n);
  for (std::size_t i = 0; i < n; ++i) cell_of_[i] = numbering_.insert(coordinates_[i]);

  // Counting sort of the points by cell: counts, then ends, then, filling from behind, starts.
  first_.assign(static_cast<std::size_t>(cells()) + 1, 0);
  for (const std::int32_t cell : cell_of_) ++first_[cell];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  point_.resize(n);
  position_.resize(n);
  for (std::size_t i = n; i-- > 0;) {
    const std::int32_t place = --first_[cell_of_[i]];
    point_[place] = static_cast<std::int32_t>(i);
    position_[place] = wrapped[i];
  }
}

bool CellGrid::separates_images(int reach) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (layout_[k].cells != 0 && layout_[k].cells < 2 * reach + 1) return false;
  return true;
}

std::int32_t CellGrid::neighbor(std::int32_t cell, CellCoordinates offset, Vec3& shift) const {
  CellCoordinates c = numbering_.coordinates(cell);
  shift = {};
  for (std::size_t k = 0; k < 3; ++k) {
    c[k] += offset[k];
    const CellLayout::Direction& direction = layout_[k];
    if (direction.cells == 0) continue;
    for (; c[k] < 0; c[k] += direction.cells) shift = shift - direction.period;
    for (; c[k] >= direction.cells; c[k] -= direction.cells) shift = shift + direction.period;
  }
  return numbering_.find(c);
}

std::size_t CellGrid::memory_bytes() const {
  return numbering_.memory_bytes() + position_.capacity() * sizeof(Vec3) +
         coordinates_.capacity() * sizeof(CellCoordinates) +
         (cell_of_.capacity() + first_.capacity() + point_.capacity()) * sizeof(std::int32_t);
}

}  // namespace dch::detail
