// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>

#pragma GCC visibility push(default)
namespace dch {

struct NearestParams {
  std::int32_t k = 1;  ///< how many neighbors of each point, 1..kMaxNearest
  /// 0 for the nearest ones; else the distance of the j-th one may be up to 1 + epsilon times that of the
  /// j-th nearest, for queries that look at fewer nodes (Theorem 5.6.9).
  double epsilon = 0;
  /// Threads to search with; null for that of the caller alone. Not owned; results do not depend on it.
  Executor* executor = nullptr;
};

inline constexpr std::int32_t kMaxNearest = 1 << 20;

/// Work of queries, for tests and for comparisons on any machine. A count does not depend on the number of
/// threads.
struct NearestWork {
  std::int64_t nodes = 0;   ///< balls of subtrees compared with a query
  std::int64_t blocks = 0;  ///< boxes of eight points compared with a query, or with another box
  std::int64_t points = 0;  ///< points whose distance was computed, or places for them in blocks
};

/// The nearest neighbors of some points, k entries a row, nearest first; of points equally near, the one with
/// the smaller id comes first. Rows are filled up with id -1 at distance infinity where there are fewer than
/// k points.
struct NearestRows {
  std::int32_t k = 0;
  std::vector<std::int32_t> id;   ///< k a row
  std::vector<double> distance2;  ///< the same: squared distances [length^2]
  NearestWork work;               ///< to find them

  std::size_t size() const { return k > 0 ? id.size() / static_cast<std::size_t>(k) : 0; }
  Span<const std::int32_t> row(std::size_t i) const {
    const auto width = static_cast<std::size_t>(k);
    return {id.data() + i * width, width};
  }
};

/// k nearest neighbors in a hierarchy (thesis 5.6.4), in every box: distances are those of nearest images
/// (Box::distance2), and each point counts once, however many images of it are near.
///
///     dch::Hierarchy hierarchy(params);
///     hierarchy.build(positions, box);
///     dch::NearestRows rows = dch::Nearest(hierarchy.view()).of_points({12});
///
/// Subtrees are pruned by the ball around each node that holds its points, as measured, so answers are right
/// whether or not a repair is put off. An object is good until the hierarchy is next changed. Queries are
/// constant: several threads may ask at once.
class Nearest {
 public:
  /// Measures the balls of all subtrees, O(nodes of level 1 and above), unless the hierarchy keeps them up
  /// (Hierarchy::kept_view()).
  explicit Nearest(const HierarchyView& view);
  ~Nearest();
  Nearest(Nearest&&) noexcept;
  Nearest& operator=(Nearest&&) noexcept;

  /// The nearest other points of each point; row i is that of id i, and rows of ids that were removed hold
  /// nothing. Whole blocks of points are asked for at once, O(k) a point where density varies little; of a
  /// kept_view() one point after the other. The memory of `rows` is taken again where it is enough.
  /// @throws InvalidParameter for a k or an epsilon out of range; `rows` is as it was then.
  void of_points(const NearestParams& params, NearestRows& rows) const;
  NearestRows of_points(const NearestParams& params) const {
    NearestRows rows;
    of_points(params, rows);
    return rows;
  }

  /// The nearest points of each position, which need not be one of a point. O(lg alpha + k) each.
  /// @throws InvalidPosition for a coordinate that is not finite or too large; as of_points() otherwise.
  void of_positions(Span<const Vec3> positions, const NearestParams& params, NearestRows& rows) const;
  NearestRows of_positions(Span<const Vec3> positions, const NearestParams& params) const {
    NearestRows rows;
    of_positions(positions, params, rows);
    return rows;
  }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch
#pragma GCC visibility pop
