// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <dch/base/vec3.hpp>

namespace dch::kinetic {

/// A linear map in three dimensions, by rows.
struct Matrix {
  std::array<Vec3, 3> rows{};

  Vec3 operator*(Vec3 v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  Matrix operator*(const Matrix& other) const {
    Matrix product;
    for (int k = 0; k < 3; ++k) {
      const Vec3 column{other.rows[0][k], other.rows[1][k], other.rows[2][k]};
      for (std::size_t row = 0; row < 3; ++row) product.rows[row][k] = dot(rows[row], column);
    }
    return product;
  }
  /// Adds the map x -> u (v . x).
  void add_outer(Vec3 u, Vec3 v) {
    for (int row = 0; row < 3; ++row)
      rows[static_cast<std::size_t>(row)] = rows[static_cast<std::size_t>(row)] + u[row] * v;
  }
  double determinant() const { return dot(rows[0], cross(rows[1], rows[2])); }
  /// Of a map whose determinant is not 0.
  Matrix inverse() const {
    const double scale = 1 / determinant();
    const std::array<Vec3, 3> columns{scale * cross(rows[1], rows[2]), scale * cross(rows[2], rows[0]),
                                      scale * cross(rows[0], rows[1])};
    Matrix inverse;
    for (int row = 0; row < 3; ++row)
      inverse.rows[static_cast<std::size_t>(row)] = {columns[0][row], columns[1][row], columns[2][row]};
    return inverse;
  }
  /// At least the factor by which it makes any vector longer.
  double norm() const { return std::sqrt(norm2(rows[0]) + norm2(rows[1]) + norm2(rows[2])); }
};

/// The identity and a multiple of a map.
inline Matrix identity_plus(double factor, const Matrix& map) {
  Matrix sum;
  for (std::size_t row = 0; row < 3; ++row) {
    sum.rows[row] = factor * map.rows[row];
    sum.rows[row][static_cast<int>(row)] += 1;
  }
  return sum;
}

}  // namespace dch::kinetic
