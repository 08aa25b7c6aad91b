// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include <dch/base/vec3.hpp>
#include <dch/zonotope/zonotope.hpp>

#pragma GCC visibility push(default)
namespace dch::zonotope {

/// What queries took. Counts are added up.
struct IndexStats {
  std::int64_t queries = 0;
  std::int64_t operations = 0;  ///< comparisons, and generators looked at
  std::int64_t searches =
      0;  ///< queries that were answered without the index, near the boundary or its edges
};

/// Answers many questions about one zonotope of n generators in space: whether it contains a point, and the
/// norm of a vector. With m entries of memory, n <= m <= n^2, a query takes O(n^2 / m log^2 n) on average
/// (thesis 3.5.2, Lemma 3.5.3, Corollary 3.5.4).
///
/// The plane of normals is cut at r = m / n vertical lines with about the same number of vertices of the dual
/// arrangement between each two, and each strip into r bands with the same number of lines at its ends: r^2
/// cells, each crossed by 3 n / r lines on average, in the place of a (1/r)-cutting, whose cells would be
/// crossed by O(n / r) lines each; one cell here may be crossed by O(n / sqrt r). Each cut keeps the lines
/// that cross it in order, with sums of generators, so that the least of h(n) / (n . x) on it, and on which
/// side of it the least of all is, take a binary search; the norm is the reciprocal. In the cell the search
/// of Theorem 3.5.2 goes on with the lines that cross it alone. The vertical lines are drawn from random
/// vertices (fixed seed).
class ZonotopeIndex {
 public:
  /// @param memory in entries, m; below n as n, above n^2 as n^2
  /// @throws InvalidParameter if the generators do not span space; InvalidPosition as check()
  ZonotopeIndex(const Zonotope& z, std::int64_t memory);
  ZonotopeIndex(ZonotopeIndex&&) noexcept;
  ZonotopeIndex& operator=(ZonotopeIndex&&) noexcept;
  ~ZonotopeIndex();

  /// As contains() in membership.hpp: where the norm is within 1e-9 of 1 that function answers.
  /// @throws InvalidPosition for a point that is not finite or beyond kMaxMagnitude
  bool contains(Vec3 point) const;
  /// As norm() in norm.hpp, in doubles: a relative error of about 1e-10.
  /// @throws InvalidPosition likewise
  double norm(Vec3 x) const;

  std::int64_t entries() const;  ///< of all cuts and cells
  const IndexStats& stats() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch::zonotope
#pragma GCC visibility pop
