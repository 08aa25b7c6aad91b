// SPDX-License-Identifier: MIT
#include "grid/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <dch/base/index_count.hpp>

namespace dch::detail {
namespace {

/// Coordinates beyond this many cells from the middle of the points share the outermost cell. Small enough
/// that the rounding of a coordinate stays below kWidthMargin cells.
constexpr double kFarthest = 1 << 30;
constexpr double kWidthMargin = 1e-6;
/// A dense block may have this many cells for each point.
constexpr double kDenseCellsPerPoint = 4;

/// Unit vectors that complete `rank` independent vectors to a basis, orthogonal to them and to each other:
/// exactly the axes if the vectors are parallel to axes.
std::vector<Vec3> orthogonal_complement(const std::array<Vec3, 3>& vectors, int rank) {
  std::vector<Vec3> frame;  // orthonormal
  const auto remainder = [&](Vec3 v) {
    for (const Vec3 e : frame) v = v - dot(v, e) * e;
    return v;
  };
  const auto add = [&](Vec3 v) { frame.push_back((1 / std::sqrt(norm2(v))) * v); };
  for (int k = 0; k < rank; ++k) add(remainder(vectors[static_cast<std::size_t>(k)]));
  while (frame.size() < 3) {
    Vec3 best;
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      if (const Vec3 v = remainder(axis); norm2(v) > norm2(best)) best = v;
    }
    add(best);
  }
  return {frame.begin() + rank, frame.end()};
}

/// A point in the midst of the points along a row: the median of a small sample, which outliers do not move.
Vec3 middle_along(Vec3 row, Span<const Vec3> points) {
  constexpr std::size_t kSample = 31;
  if (points.empty()) return {};
  std::vector<Vec3> sample;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSample);
  for (std::size_t i = 0; i < points.size(); i += stride) sample.push_back(points[i]);
  const auto median = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), median, sample.end(),
                   [&](Vec3 p, Vec3 q) { return dot(row, p) < dot(row, q); });
  return *median;
}

/// Largest integer <= x, for |x| < 2^31.
std::int32_t floor_to_integer(double x) {
  const auto n = static_cast<std::int32_t>(x);
  return n - (x < n);
}

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

void CellGrid::lay_out(Span<const Vec3> points, const Box& box, double width) {
  const int rank = box.rank();
  const double widened = width * (1 + kWidthMargin);
  for (std::size_t k = 0; k < static_cast<std::size_t>(rank); ++k) {
    const Vec3 dual = box.reduced_dual()[k];
    const double height = 1 / std::sqrt(norm2(dual));
    const auto cells = static_cast<std::int32_t>(std::clamp(height / widened, 1.0, kFarthest));
    const Vec3 row = static_cast<double>(cells) * dual;
    directions_[k] = {row, box.origin(), cells, box.reduced()[k]};
  }
  const auto normals = orthogonal_complement(box.reduced(), rank);
  for (std::size_t k = 0; k < normals.size(); ++k) {
    const Vec3 row = (1 / widened) * normals[k];
    directions_[k + static_cast<std::size_t>(rank)] = {row, middle_along(row, points), 0, {}};
  }
}

std::int32_t CellGrid::Direction::coordinate(Vec3 p) const {
  const std::int32_t c = floor_to_integer(std::clamp(dot(row, p - origin), -kFarthest, kFarthest));
  if (cells == 0) return c;
  return std::clamp(c, 0, cells - 1);  // rounding may leave a wrapped point a little outside
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
  lay_out(wrapped, box, width);

  coordinates_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 3; ++k) coordinates_[i][k] = directions_[k].coordinate(wrapped[i]);
  }
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
  return std::all_of(directions_.begin(), directions_.end(), [&](const Direction& direction) {
    return direction.cells == 0 || direction.cells >= 2 * reach + 1;
  });
}

std::int32_t CellGrid::neighbor(std::int32_t cell, CellCoordinates offset, Vec3& shift) const {
  CellCoordinates c = numbering_.coordinates(cell);
  shift = {};
  for (std::size_t k = 0; k < 3; ++k) {
    c[k] += offset[k];
    const Direction& direction = directions_[k];
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
