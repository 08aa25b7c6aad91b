// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/lists/neighbor_list.hpp>

namespace dch::kinetic {

/// Pairs of points, in the rows of both, in no order that counts.
class MutualRows {
 public:
  explicit MutualRows(std::size_t points) : rows_(points), is_new_(points, 0) {}

  const std::vector<std::int32_t>& of(std::int32_t id) const { return rows_[static_cast<std::size_t>(id)]; }

  /// Makes the pairs of a half list those of all points.
  void replace_all(const NeighborList& list) {
    for (std::vector<std::int32_t>& row : rows_) row.clear();
    for (std::size_t k = 0; k < list.size(); ++k) {
      const std::int32_t a = list.particle.empty() ? static_cast<std::int32_t>(k) : list.particle[k];
      for (const std::int32_t b : list.row(k)) {
        rows_[static_cast<std::size_t>(a)].push_back(b);
        rows_[static_cast<std::size_t>(b)].push_back(a);
      }
    }
  }
  /// Makes a row that of a point, and tells of the places of partners that it had not, and of those that it
  /// had, before.
  template <class Added, class Dropped>
  void replace(std::int32_t id, const std::vector<std::int32_t>& row, const Added& added,
               const Dropped& dropped) {
    std::vector<std::int32_t>& mine = rows_[static_cast<std::size_t>(id)];
    for (const std::int32_t other : row) is_new_[static_cast<std::size_t>(other)] = 1;
    for (const std::int32_t other : mine) {
      char& is_in_row = is_new_[static_cast<std::size_t>(other)];
      if (!is_in_row) {
        erase(other, id);
        dropped(other);
      }
      is_in_row = 0;
    }
    mine = row;
    for (std::size_t place = 0; place < row.size(); ++place) {
      char& is_new = is_new_[static_cast<std::size_t>(row[place])];
      if (is_new) {
        rows_[static_cast<std::size_t>(row[place])].push_back(id);
        added(place);
      }
      is_new = 0;
    }
  }

 private:
  void erase(std::int32_t id, std::int32_t partner) {
    std::vector<std::int32_t>& row = rows_[static_cast<std::size_t>(id)];
    *std::find(row.begin(), row.end(), partner) = row.back();
    row.pop_back();
  }

  std::vector<std::vector<std::int32_t>> rows_;
  std::vector<char> is_new_;  ///< of the row at hand
};

}  // namespace dch::kinetic
