// SPDX-License-Identifier: MIT
#include "grid/cell_layout.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dch::detail {
namespace {

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

constexpr double kOutermost =
    0x1p-10;  ///< of the last cell of a period: what points beyond it are put at [cells]

/// A point in the midst of the points along a row: the median of a small sample, which outliers do not move.
Vec3 middle_along(Vec3 row, Span<const Vec3> points) {
  constexpr std::size_t kSample = 31;
  if (points.empty()) return {};
  std::vector<Vec3> sample;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSample);
  for (std::size_t i = 0; i < points.size(); i += stride)
    if (std::isfinite(dot(row, points[i]))) sample.push_back(points[i]);  // others are about to be refused
  if (sample.empty()) return {};
  const auto median = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), median, sample.end(),
                   [&](Vec3 p, Vec3 q) { return dot(row, p) < dot(row, q); });
  return *median;
}

}  // namespace

CellLayout::CellLayout(Span<const Vec3> points, const Box& box, double width) {
  const int rank = box.rank();
  const double widened = width * (1 + kMargin);
  for (std::size_t k = 0; k < static_cast<std::size_t>(rank); ++k) {
    const Vec3 dual = box.reduced_dual()[k];
    const double height = 1 / std::sqrt(norm2(dual));
    const auto cells = static_cast<std::int32_t>(std::clamp(height / widened, 1.0, kFarthest));
    const Vec3 period = box.reduced()[k];
    directions_[k] = {
        static_cast<double>(cells) * dual, (1.0 / cells) * period, cells, period, 0, cells - kOutermost};
  }
  origin_ = box.origin();
  const auto normals = orthogonal_complement(box.reduced(), rank);
  for (std::size_t k = 0; k < normals.size(); ++k) {
    Direction& direction = directions_[k + static_cast<std::size_t>(rank)];
    direction.row = (1 / widened) * normals[k];
    direction.edge = widened * normals[k];
    origin_ = origin_ + dot(normals[k], middle_along(normals[k], points) - origin_) * normals[k];
  }
  right_angles_ = true;
  for (std::size_t k = 0; k < 3; ++k) {
    int components = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (directions_[k].row[axis] == 0) continue;
      ++components;
      axis_[k] = axis;
      along_[k] = directions_[k].row[axis];
    }
    right_angles_ = right_angles_ && components == 1;
  }
  for (std::size_t k = 0; k < 3; ++k)
    pieces_[k] = {std::max(kPieces * directions_[k].least, -kFarthest),
                  std::min(kPieces * directions_[k].most, kFarthest - 1)};
  std::array<Vec3, 3> frame;
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3 rest = directions_[k].edge;
    for (std::size_t before = 0; before < k; ++before) {
      edges_[before][k] = dot(frame[before], directions_[k].edge);
      rest = rest - edges_[before][k] * frame[before];
    }
    edges_[k][k] = std::sqrt(norm2(rest));
    frame[k] = (1 / edges_[k][k]) * rest;
  }
}

CellLayout::Axes CellLayout::axes() const {
  Axes axes{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(axis_[k]);
    axes.origin[axis] = origin_[axis_[k]];
    axes.per_piece[axis] = kPieces * along_[k];
    axes.least[axis] = pieces_[k].least;
    axes.most[axis] = pieces_[k].most;
  }
  return axes;
}

Vec3 CellLayout::extent() const {
  Vec3 sides;
  for (const Direction& direction : directions_)
    for (int axis = 0; axis < 3; ++axis) sides[axis] += std::abs(direction.edge[axis]);
  return sides;
}

}  // namespace dch::detail
