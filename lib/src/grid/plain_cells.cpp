// SPDX-License-Identifier: MIT
#include "grid/plain_cells.hpp"

#include <algorithm>

#include "geometry/metric.hpp"

namespace dch::detail {
namespace {

/// Half of the offsets: of each pair of opposite ones the lexicographically positive one.
std::vector<CellCoordinates> half_stencil(int reach) {
  std::vector<CellCoordinates> offsets;
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        if (z > 0 || (z == 0 && (y > 0 || (y == 0 && x > 0)))) offsets.push_back({x, y, z});
      }
    }
  }
  return offsets;
}

}  // namespace

void PlainCells::find_rows(const Box& box, const PairFilter& filter, const Row& row) {
  if (grid_.separates_images(divisions_)) {
    find_by_shifts(filter, row);
  } else {
    find_by_nearest_images(box, filter, row);
  }
}

void PlainCells::gather(std::int32_t cell, Vec3 shift) {
  for (auto place = grid_.first_place(cell); place < grid_.first_place(cell + 1); ++place) {
    candidates_.append_if(true, grid_.position(place) + shift, grid_.point(place));
  }
}

void PlainCells::find_by_shifts(const PairFilter& filter, const Row& row) {
  const auto offsets = half_stencil(divisions_);
  const OpenMetric metric{Box::none()};
  for (std::int32_t cell = 0; cell < grid_.cells(); ++cell) {
    candidates_.clear();
    gather(cell, {});
    const std::size_t own_count = candidates_.size();
    if (own_count == 0) continue;
    for (const CellCoordinates& offset : offsets) {
      Vec3 shift;
      const std::int32_t other = grid_.neighbor(cell, offset, shift);
      if (other != CellNumbering::kNone) gather(other, shift);
    }
    test_gathered(metric, own_count, filter, row);
  }
}

/// For boxes so narrow that a cell meets another one, or itself, on both sides: every pair of cells once, and
/// nearest images for each pair of points.
void PlainCells::find_by_nearest_images(const Box& box, const PairFilter& filter, const Row& row) {
  const auto offsets = half_stencil(divisions_);
  std::vector<std::int32_t> others;
  with_metric(box, [&](const auto& metric) {
    for (std::int32_t cell = 0; cell < grid_.cells(); ++cell) {
      candidates_.clear();
      gather(cell, {});
      const std::size_t own_count = candidates_.size();
      if (own_count == 0) continue;
      others.clear();
      for (const CellCoordinates& o : offsets) {
        for (const int sign : {1, -1}) {
          Vec3 shift;
          const std::int32_t other = grid_.neighbor(cell, {sign * o[0], sign * o[1], sign * o[2]}, shift);
          if (other > cell) others.push_back(other);
        }
      }
      std::sort(others.begin(), others.end());
      others.erase(std::unique(others.begin(), others.end()), others.end());
      for (const std::int32_t other : others) gather(other, {});
      test_gathered(metric, own_count, filter, row);
    }
  });
}

/// The first `own_count` candidates with each other and with all that follow.
template <class Metric>
void PlainCells::test_gathered(const Metric& metric, std::size_t own_count, const PairFilter& filter,
                               const Row& row) {
  for (std::size_t a = 0; a < own_count; ++a) {
    const std::int32_t i = candidates_.node(a);
    const std::size_t hits =
        candidates_.select(metric, candidates_.position(a), a + 1, filter.largest_distance2());
    others_.clear();
    for (std::size_t h = 0; h < hits; ++h) {
      const std::size_t b = candidates_.hit(h);
      if (filter.accept(i, candidates_.node(b), candidates_.distance2(b)))
        others_.push_back(candidates_.node(b));
    }
    row(i, others_);
  }
}

}  // namespace dch::detail
