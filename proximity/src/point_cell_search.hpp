// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/proximity/nearest.hpp>

#include "point_cells.hpp"

namespace dch::detail {

/// Questions to a grid of cells, one at a time. What is found is all that can be an answer; who asks computes
/// the distances.
class PointCellSearch {
 public:
  struct Found {
    std::uint32_t units2;  ///< squared distance in units of cells, rounded
    std::int32_t id;
  };

  /// All points within a distance, up to two widths of the narrowest side of a cell [length], and a few
  /// others.
  /// @return whether there is an answer
  bool within(const PointCells& grid, Vec3 at, double distance);
  /// The k nearest points, or points that are no farther than (1 + epsilon) times as far, and a few others,
  /// if k of them are within bound(). Else a point that is far away has the coordinates of one that is near,
  /// and there is no answer.
  /// @return whether there is an answer, at a cost that a descent hardly has
  bool nearest(const PointCells& grid, Vec3 at, std::int32_t k, double epsilon);

  Span<const Found> found() const { return {found_.data(), size_}; }
  double bound() const { return bound_; }  ///< of distances as Box::distance2() computes them [length]
  NearestWork work;

 private:
  struct Range {
    std::int64_t low = 0, high = -1;  ///< cells, both in it
    std::int64_t size() const { return high - low + 1; }
    bool has(std::int64_t cell) const { return low <= cell && cell <= high; }
  };
  using Ranges = std::array<Range, 3>;
  struct Layer {  ///< the cells of one coordinate
    PointCells::Coordinate at;
    double gap2;
    bool seen;
  };
  struct Cell {
    std::int32_t line;
    std::array<std::uint16_t, 3> query, name;
  };

  bool start(const PointCells& grid, Vec3 at);
  Ranges nearest_eight() const;
  Ranges touched_by(double distance) const;
  static Ranges wider(Ranges ranges);
  static Ranges both(const Ranges& a, const Ranges& b);
  double clearance(const Ranges& ranges) const;
  double gap2(std::size_t axis, std::int64_t cell) const;
  bool collect(const Ranges& ranges, const Ranges& seen, double distance);
  bool look_at_cells();
  void look_at(const Cell& cell, const PointCells::Line& line);
  double distance_of(std::size_t k);
  void keep_within(double distance);

  const PointCells* grid_ = nullptr;
  std::array<double, 3> at_{};  ///< in cells
  std::array<std::int64_t, 3> units_{};
  std::vector<Cell> cells_;
  std::vector<Found> found_;  ///< the first size_ of them
  std::size_t size_ = 0;
  double bound_ = 0;
};

}  // namespace dch::detail
