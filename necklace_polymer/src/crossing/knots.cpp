// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <dch/necklace/knots.hpp>

#include "crossing/projection.hpp"

namespace dch::necklace {
namespace {

constexpr double kPi = 3.141592653589793;

/// The solid angle of a spherical triangle, signed (Van Oosterom and Strackee, IEEE Trans. Biomed. Eng.
/// 30:125, 1983).
double triangle(Vec3 a, Vec3 b, Vec3 c) {
  const double la = std::sqrt(norm2(a)), lb = std::sqrt(norm2(b)), lc = std::sqrt(norm2(c));
  const double volume = dot(a, cross(b, c));
  if (volume == 0) return 0;
  return 2 * std::atan2(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/// What two segments p and q give to Gauss's integral: the area of directions from one to the other.
double gauss(Vec3 p0, Vec3 p1, Vec3 q0, Vec3 q1) {
  const Vec3 a = q0 - p0, b = q0 - p1, c = q1 - p1, d = q1 - p0;
  return triangle(a, b, c) + triangle(a, c, d);
}

/// A passage of a ring under or over itself.
struct Pass {
  std::size_t segment;
  double place, error;
  std::size_t overlap;
  bool is_under;
};

/// The passes in order along the ring, or nothing where two are too close to tell.
std::optional<std::vector<Pass>> passes_of(const std::vector<detail::Overlap>& overlaps) {
  std::vector<Pass> passes;
  for (std::size_t k = 0; k < overlaps.size(); ++k) {
    const detail::Overlap& overlap = overlaps[k];
    passes.push_back({overlap.a, overlap.on_a, overlap.error, k, !overlap.a_is_over});
    passes.push_back({overlap.b, overlap.on_b, overlap.error, k, overlap.a_is_over});
  }
  std::sort(passes.begin(), passes.end(), [](const Pass& a, const Pass& b) {
    return a.segment != b.segment ? a.segment < b.segment : a.place < b.place;
  });
  for (std::size_t k = 1; k < passes.size(); ++k) {
    const Pass &a = passes[k - 1], &b = passes[k];
    if (a.segment == b.segment && b.place - a.place <= a.error + b.error) return std::nullopt;
  }
  return passes;
}

using Matrix = std::vector<std::vector<std::int64_t>>;

/// By crossing, 2 for the arc above and -1 for each of the two arcs that end below; without the last row and
/// column.
Matrix coloring_minor(const std::vector<Pass>& passes) {
  const std::size_t count = passes.size() / 2;
  Matrix matrix(count, std::vector<std::int64_t>(count, 0));
  std::size_t arc = 0;
  for (const Pass& pass : passes) {
    if (!pass.is_under) {
      matrix[pass.overlap][arc] += 2;
      continue;
    }
    matrix[pass.overlap][arc] -= 1;
    arc = (arc + 1) % count;
    matrix[pass.overlap][arc] -= 1;
  }
  if (matrix.empty()) return matrix;
  matrix.pop_back();
  for (auto& row : matrix) row.pop_back();
  return matrix;
}

std::int64_t power(std::int64_t base, std::int64_t exponent, std::int64_t prime) {
  std::int64_t result = 1;
  for (; exponent > 0; exponent /= 2, base = base * base % prime) {
    if (exponent % 2 == 1) result = result * base % prime;
  }
  return result;
}

std::int64_t determinant(Matrix m, std::int64_t prime) {
  std::int64_t result = 1;
  for (std::size_t k = 0; k < m.size(); ++k) {
    std::size_t pivot = k;
    while (pivot < m.size() && m[pivot][k] % prime == 0) ++pivot;
    if (pivot == m.size()) return 0;
    if (pivot != k) std::swap(m[pivot], m[k]), result = prime - result;
    result = result * ((m[k][k] % prime + prime) % prime) % prime;
    const std::int64_t inverse = power((m[k][k] % prime + prime) % prime, prime - 2, prime);
    for (std::size_t row = k + 1; row < m.size(); ++row) {
      if (m[row][k] % prime == 0) continue;
      const std::int64_t factor = (m[row][k] % prime + prime) % prime * inverse % prime;
      for (std::size_t column = k; column < m.size(); ++column)
        m[row][column] = (m[row][column] - factor * m[k][column]) % prime;
    }
  }
  return result % prime;
}

std::int64_t next_prime_below(std::int64_t number) {
  const auto is_prime = [](std::int64_t n) {
    for (std::int64_t k = 3; k * k <= n; k += 2) {
      if (n % k == 0) return false;
    }
    return true;
  };
  do number -= 2;
  while (!is_prime(number));
  return number;
}

/// Its magnitude, from residues of so many primes that their product is more than twice Hadamard's bound.
std::int64_t determinant(const Matrix& matrix) {
  double bits = 2;
  for (const auto& row : matrix) {
    double norm2 = 0;
    for (const std::int64_t entry : row) norm2 += static_cast<double>(entry * entry);
    if (norm2 == 0) return 0;
    bits += 0.5 * std::log2(norm2);
  }
  const std::int64_t first = next_prime_below((std::int64_t{1} << 31) + 1), second = next_prime_below(first);
  const std::int64_t of_first = determinant(matrix, first), of_second = determinant(matrix, second);
  // The number below first * second in magnitude that has these two residues.
  const std::int64_t difference = ((of_second - of_first) % second + second) % second;
  std::int64_t value = of_first + first * (difference * power(first % second, second - 2, second) % second);
  if (value > first * second / 2) value -= first * second;
  std::int64_t prime = second;
  for (int known = 60; known < bits; known += 30) {
    prime = next_prime_below(prime);
    if (((value - determinant(matrix, prime)) % prime + prime) % prime != 0) {
      throw InvalidParameter("the knot's determinant is larger than 2^60; use shorter rings");
    }
  }
  return std::abs(value);
}

}  // namespace

std::int64_t linking_number(Span<const Vec3> a, Span<const Vec3> b) {
  detail::check_ring(a);
  detail::check_ring(b);
  for (int direction = 0; direction < detail::Projection::kDirections; ++direction) {
    const auto overlaps = detail::Projection(direction).overlaps(a, b);
    if (!overlaps) continue;
    std::int64_t sum = 0;
    for (const detail::Overlap& overlap : *overlaps) sum += overlap.a_is_over ? overlap.sign : 0;
    return sum;
  }
  throw RingsTouch(detail::no_projection("two rings touch, to within rounding,"));
}

double writhe(Span<const Vec3> ring) {
  detail::check_ring(ring);
  const std::size_t n = ring.size();
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      sum += gauss(ring[i], ring[i + 1], ring[j], ring[(j + 1) % n]);
    }
  }
  return sum / (2 * kPi);
}

std::int64_t knot_determinant(Span<const Vec3> ring) {
  detail::check_ring(ring);
  for (int direction = 0; direction < detail::Projection::kDirections; ++direction) {
    const auto overlaps = detail::Projection(direction).overlaps(ring);
    if (!overlaps) continue;
    const auto passes = passes_of(*overlaps);
    if (!passes) continue;
    return determinant(coloring_minor(*passes));
  }
  throw RingsTouch(detail::no_projection("a ring touches itself, to within rounding,"));
}

}  // namespace dch::necklace
