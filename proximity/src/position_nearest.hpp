// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/proximity/nearest.hpp>

#include "hierarchy/structure.hpp"
#include "hierarchy/subtree_balls.hpp"
#include "nearest_candidates.hpp"
#include "nearest_descent.hpp"

namespace dch::detail {

/// @throws InvalidParameter for a k or an epsilon out of range.
void check(const NearestParams& params);

/// Rows to be filled, in the memory that there is if it is enough: new pages take long to come.
void make_rows(std::size_t rows, std::int32_t k, NearestRows& out);

/// In which to ask: queries near each other look at the same subtrees, which are in the cache then.
std::vector<std::int32_t> order_of_queries(Span<const Vec3> positions, const Structure& structure);

void add(const NearestWork& more, NearestWork& sum);

inline void write_row(const NearestCandidates& best, std::size_t row, NearestRows& rows) {
  const std::size_t first = row * static_cast<std::size_t>(rows.k);
  best.write(rows.id.data() + first, rows.distance2.data() + first);
}

/// Descents, one position after the other.
template <class Metric>
class PositionNearest {
 public:
  PositionNearest(const Metric& metric, const Structure& structure, const SubtreeBalls& balls,
                  const NearestParams& params)
      : params_(params), descent_(metric, structure, balls) {}

  void search(Vec3 position, std::size_t row, NearestRows& rows) {
    best_.clear(params_.k);
    descent_.search(position, -1, params_.epsilon, best_);
    write_row(best_, row, rows);
  }
  NearestWork work() const { return descent_.work; }

 private:
  const NearestParams& params_;
  NearestDescent<Metric> descent_;
  NearestCandidates best_;
};

}  // namespace dch::detail
