// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include <dch/hierarchy/hierarchy_view.hpp>
#include <dch/proximity/nearest.hpp>

namespace dch {

struct Neighbor {
  double distance2;
  std::int32_t id;
  bool operator<(const Neighbor& other) const {
    return distance2 != other.distance2 ? distance2 < other.distance2 : id < other.id;
  }
};

/// The oracle: all points of the set but one, sorted.
inline std::vector<Neighbor> sorted_by_distance(const HierarchyView& view, Vec3 from, std::int32_t self) {
  std::vector<Neighbor> all;
  for (std::int32_t id = 0; id < static_cast<std::int32_t>(view.capacity()); ++id)
    if (view.contains(id) && id != self) all.push_back({view.box().distance2(from, view.position(id)), id});
  std::sort(all.begin(), all.end());
  return all;
}

/// A row beside all points, sorted: the same, or within 1 + epsilon of as far.
inline void check_row(const NearestRows& rows, std::size_t row, const std::vector<Neighbor>& expected,
                      double epsilon, const std::string& what) {
  const Span<const std::int32_t> ids = rows.row(row);
  for (std::size_t j = 0; j < ids.size(); ++j) {
    const double distance2 = rows.distance2[row * ids.size() + j];
    const std::string where = what + ", row " + std::to_string(row) + ", neighbor " + std::to_string(j) +
                              " of " + std::to_string(ids.size());
    if (j >= expected.size()) {
      ASSERT_EQ(ids[j], -1) << where;
      ASSERT_EQ(distance2, std::numeric_limits<double>::infinity()) << where;
    } else if (epsilon == 0) {
      ASSERT_EQ(ids[j], expected[j].id) << where;
      ASSERT_EQ(distance2, expected[j].distance2) << where;
    } else {
      ASSERT_GE(ids[j], 0) << where;
      ASSERT_LE(std::sqrt(distance2), (1 + epsilon) * std::sqrt(expected[j].distance2)) << where;
    }
  }
}

}  // namespace dch
