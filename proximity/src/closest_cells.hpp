// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <dch/base/vec3.hpp>
#include <dch/proximity/nearest.hpp>

#include "hierarchy/structure.hpp"
#include "point_cell_search.hpp"
#include "point_cells.hpp"

namespace dch::detail {

/// Points near others by cells, which are made when descents have cost as much.
class ClosestCells {
 public:
  void clear() { cells_.clear(); }
  /// The points are others.
  void forget() {
    clear();
    patience_ = 1;
  }
  bool empty() const { return cells_.empty(); }
  void grow(std::size_t ids) {
    if (!empty()) cells_.grow(ids);
  }
  void insert(std::int32_t id, Vec3 at) {
    if (!empty()) cells_.insert(id, at);
  }
  void remove(std::int32_t id) {
    if (!empty()) cells_.remove(id);
  }
  /// A point was asked for by descent.
  void note_descent() { ++descents_; }

  /// Calls act(id) for all points within a reach, which may be infinite, and for a few others [length].
  /// @return whether the cells have an answer
  template <class Act>
  bool for_each_within(const Structure& structure, Vec3 at, double reach, const Act& act) {
    if (!std::isfinite(reach)) return false;
    if (descents_ * kShareOfDescents >= patience_ * static_cast<std::int64_t>(structure.raw.size()))
      make(structure, reach);
    if (!serve(reach) || !search_.within(cells_, at, reach)) return false;
    for (const PointCellSearch::Found& found : search_.found()) act(found.id);
    return true;
  }
  NearestWork take_work() { return std::exchange(search_.work, {}); }

 private:
  /// Cells are made when as many points as this share of all have been asked for by descent, which took as
  /// long; the next ones after twice as many.
  static constexpr std::int64_t kShareOfDescents = 128;
  /// How far points look, in widths of cells.
  static constexpr double kMostWidths = 2;
  /// Cells made for a reach are so many times as wide: it may grow.
  static constexpr double kWider = 2.5;

  bool serve(double reach) const { return !empty() && reach <= kMostWidths * cells_.least_width(); }
  /// As wide as suits the density of the points, or, where many of those are overfull, the reach.
  void make(const Structure& structure, double reach) {
    descents_ = 0;
    patience_ *= 2;
    if (serve(reach)) {
      cells_.make(structure, kWider * reach);
    } else {
      cells_.make(structure);
    }
  }

  PointCells cells_;
  PointCellSearch search_;
  std::int64_t descents_ = 0;  ///< since cells were made, or tried to
  std::int64_t patience_ = 1;  ///< so many times the share of descents before the next ones
};

}  // namespace dch::detail
