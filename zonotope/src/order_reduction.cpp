// SPDX-License-Identifier: MIT
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/span.hpp>
#include <dch/zonotope/order_reduction.hpp>

#include "base/describe.hpp"
#include "predicates.hpp"
#include "vectors.hpp"

namespace dch::zonotope {
namespace {

double length(Vec3 v) { return std::sqrt(norm2(v)); }

double total_length(const std::vector<Vec3>& vectors) {
  double sum = 0;
  for (const Vec3& v : vectors) sum += length(v);
  return sum;
}

/// Which cell of directions a vector is in, on a cube whose faces have cells^2 of them, and the vector turned
/// to the face's side.
std::pair<std::int64_t, Vec3> cell_of(Vec3 v, int cells) {
  const Vec3 m = magnitudes(v);
  const int face = m.x >= m.y && m.x >= m.z ? 0 : m.y >= m.z ? 1 : 2;
  if (v[face] < 0) v = -1.0 * v;
  std::int64_t cell = face;
  for (const int step : {1, 2}) {
    const double at = 0.5 * (v[(face + step) % 3] / v[face] + 1) * cells;
    cell = cell * cells + std::clamp(static_cast<int>(at), 0, cells - 1);
  }
  return {cell, v};
}

/// A cell's generators as one, along their mean; what is across it goes into the box.
void add_cell(const std::pair<std::int64_t, Vec3>* first, const std::pair<std::int64_t, Vec3>* last,
              Approximation& result, Vec3& box) {
  if (last - first == 1) {
    result.zonotope.generators.push_back(first->second);
    return;
  }
  Vec3 mean;
  for (const auto* member = first; member != last; ++member) mean = mean + member->second;
  mean = 1 / length(mean) * mean;
  double along = 0;
  for (const auto* member = first; member != last; ++member) along += dot(member->second, mean);
  const Vec3 generator = along * mean;
  for (const auto* member = first; member != last; ++member) {
    const Vec3 across = member->second - dot(member->second, mean) / along * generator;
    box = box + magnitudes(across);
    result.distance += length(across);
  }
  result.zonotope.generators.push_back(generator);
}

void add_box(Vec3 box, double rounding, std::vector<Vec3>& generators) {
  generators.push_back({box.x + rounding, 0, 0});
  generators.push_back({0, box.y + rounding, 0});
  generators.push_back({0, 0, box.z + rounding});
}

Approximation with_cells(const Zonotope& z, int cells, double rounding) {
  std::vector<std::pair<std::int64_t, Vec3>> sorted;
  for (const Vec3& v : z.generators) sorted.push_back(cell_of(v, cells));
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  Approximation result;
  result.zonotope.center = z.center;
  Vec3 box;
  for (std::size_t first = 0, last = 0; first < sorted.size(); first = last) {
    while (last < sorted.size() && sorted[last].first == sorted[first].first) ++last;
    add_cell(sorted.data() + first, sorted.data() + last, result, box);
  }
  add_box(box, rounding, result.zonotope.generators);
  result.distance += length(box) + 4 * rounding;
  return result;
}

/// The width in any direction is at most the diameter, and its mean over all directions is the sum of the
/// lengths.
double diameter_bound(const std::vector<Vec3>& generators) {
  double widest = total_length(generators);
  for (int k = 0; k < 13; ++k) {
    const int x = (k + 14) % 3 - 1, y = (k + 14) / 3 % 3 - 1, z = (k + 14) / 9 - 1;
    const Vec3 direction{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
    double width = 0;
    for (const Vec3& v : generators) width += 2 * std::abs(dot(v, direction));
    widest = std::max(widest, width / length(direction));
  }
  return widest * (1 - 1e-12);
}

using Frame = std::array<Vec3, 3>;

/// The left singular vectors of the matrix of the vectors, which are the eigenvectors of its square; of a
/// small matrix, so that directions of singular values below 1e-8 of the largest are off by as much. A box is
/// right in any frame.
Frame singular_vectors(const std::vector<Vec3>& vectors) {
  const double scale = 1 / total_length(vectors);
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  for (const Vec3& v : vectors) {
    const Eigen::Vector3d column(scale * v.x, scale * v.y, scale * v.z);
    square += column * column.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(square);
  Frame frame;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = solver.eigenvectors().col(k);
    frame[static_cast<std::size_t>(k)] = {axis.x(), axis.y(), axis.z()};
  }
  return frame;
}

/// How far a box in a frame has to reach to hold all of some generators.
Vec3 box_around(Span<const Vec3> vectors, const Frame& frame) {
  Vec3 widths;
  for (const Vec3& v : vectors)
    widths = widths + magnitudes({dot(v, frame[0]), dot(v, frame[1]), dot(v, frame[2])});
  return widths;
}

/// @param kept of the generators, those for which a box would be widest beside themselves
std::pair<Zonotope, double> boxed(const Zonotope& z, const Frame& frame, std::size_t kept, double rounding) {
  const auto cost = [&](Vec3 v) {
    const Vec3 m = magnitudes({dot(v, frame[0]), dot(v, frame[1]), dot(v, frame[2])});
    return m.x + m.y + m.z - std::max({m.x, m.y, m.z});
  };
  Zonotope result = z;
  std::stable_sort(result.generators.begin(), result.generators.end(),
                   [&](Vec3 a, Vec3 b) { return cost(a) > cost(b); });
  const Vec3 box = box_around({result.generators.data() + kept, result.generators.size() - kept}, frame);
  result.generators.resize(kept);
  for (const int axis : {0, 1, 2})
    result.generators.push_back((box[axis] + rounding) * frame[static_cast<std::size_t>(axis)]);
  return {std::move(result), (box.x + rounding) * (box.y + rounding) * (box.z + rounding)};
}

}  // namespace

Approximation approximated(const Zonotope& z, double epsilon) {
  if (!(epsilon >= 1e-3 && epsilon <= 1))
    throw InvalidParameter("epsilon = " + detail::describe(epsilon) +
                           " is not within 1e-3..1; choose another");
  const Zonotope given = canonical(z);
  const double diameter = diameter_bound(given.generators);
  const double rounding =
      16 * (static_cast<double>(given.generators.size()) + 16) * kRounding * total_length(given.generators);
  for (int cells = 1; cells <= 8 / epsilon; cells += 1 + cells / 8) {
    Approximation result = with_cells(given, cells, rounding);
    if (result.zonotope.generators.size() >= given.generators.size()) break;
    result.diameter = diameter;
    if (result.distance <= epsilon * diameter) return result;
  }
  return {z, 0, diameter};
}

Zonotope reduced(const Zonotope& z, std::size_t most) {
  if (most < 3)
    throw InvalidParameter("a zonotope in space is to be reduced to " + std::to_string(most) +
                           " generators; a box takes 3, give at least that");
  Zonotope given = canonical(z);
  if (given.generators.size() <= most) return given;
  const double rounding =
      16 * (static_cast<double>(given.generators.size()) + 16) * kRounding * total_length(given.generators);
  const Frame axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  auto [along_axes, axes_volume] = boxed(given, axes, most - 3, rounding);
  auto [along_vectors, vectors_volume] = boxed(given, singular_vectors(given.generators), most - 3, rounding);
  return axes_volume <= vectors_volume ? along_axes : along_vectors;
}

}  // namespace dch::zonotope
