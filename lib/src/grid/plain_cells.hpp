// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

#include "grid/cell_grid.hpp"
#include "hierarchy/candidate_buffer.hpp"
#include "lists/pair_filter.hpp"

namespace dch::detail {

/// Pairs from a grid of cells in the plainest way: in double, one after the other, in any box, however
/// narrow.
class PlainCells {
 public:
  /// @param divisions cells to a radius
  explicit PlainCells(int divisions) : divisions_(divisions) {}

  void clear() { grid_.clear(); }
  /// @param wrapped positions that Box::wrap has put into the box
  /// @param radius of the pairs, with what rounding may add [length]
  void build(Span<const Vec3> wrapped, const Box& box, double radius) {
    grid_.build(wrapped, box, radius / divisions_);
  }

  /// Calls row(i, others) for each particle: each pair that the filter accepts is in one of the rows.
  using Row = std::function<void(std::int32_t i, Span<const std::int32_t> others)>;
  void find_rows(const Box& box, const PairFilter& filter, const Row& row);

  std::size_t memory_bytes() const {
    return grid_.memory_bytes() + others_.capacity() * sizeof(std::int32_t);
  }

 private:
  void find_by_shifts(const PairFilter& filter, const Row& row);
  void find_by_nearest_images(const Box& box, const PairFilter& filter, const Row& row);
  void gather(std::int32_t cell, Vec3 shift);
  template <class Metric>
  void test_gathered(const Metric& metric, std::size_t own_count, const PairFilter& filter, const Row& row);

  int divisions_;
  CellGrid grid_;
  CandidateBuffer candidates_;        ///< points of a cell, then those of its neighbors
  std::vector<std::int32_t> others_;  ///< in the row of one point
};

}  // namespace dch::detail
