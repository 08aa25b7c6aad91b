// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

namespace dch::detail {

/// Points by the cells of a grid about as wide as they look for others. A question looks at the cells that a
/// ball touches, one to three along each axis. Where no two points are nearer than some share of the width, a
/// cell holds no more than a constant, wherever the others are. Cells are found by a hash table, with all
/// points of a place in it in one list, so their number does not matter.
///
/// For boxes whose axes are at right angles, and coordinates up to 2^30 cells.
class CloseGrid {
 public:
  /// Takes all points with a mark, for questions up to a reach and somewhat farther. Is empty after points or
  /// boxes that do not fit.
  /// @param slack by which distances may be off [length]
  void make(const Box& box, Span<const Vec3> positions, const std::vector<char>& is_there, double reach,
            double slack);
  void clear() { links_.clear(); }
  bool empty() const { return links_.empty(); }
  /// Whether questions up to that reach are answered, and by cells that are not far too wide.
  bool serves(double reach) const { return !empty() && reach <= width_ && reach >= width_ / kWidest; }

  // While it is not empty; all ids of points are known by grow().
  void grow(std::size_t ids) {
    if (ids > first_.size()) return clear();  // lists would grow
    links_.resize(ids);
  }
  void insert(std::int32_t id, Vec3 at);
  void remove(std::int32_t id);

  /// Calls look(id) for all points within reach, for others, and for some twice.
  template <class Look>
  void for_each_near(Vec3 at, double reach, const Look& look) const;

 private:
  static constexpr double kWidest = 8;  ///< width over reach
  static constexpr std::int32_t kNone = -1;
  struct Link {
    std::int32_t next = kNone, previous = kNone, place = kNone;  ///< in a list of the table
  };
  bool has_place(Vec3 at) const;
  double in_cells(Vec3 at, int axis) const { return (at[axis] - origin_[axis]) * per_length_[axis]; }
  /// Of the list of a cell, or of an image of one.
  std::size_t place_of(std::array<std::int64_t, 3> cell) const;

  double width_ = 0;                 ///< of a cell, or less [length]
  double slack_ = 0;                 ///< [length]
  Vec3 origin_;                      ///< of the grid [length]
  Vec3 per_length_;                  ///< cells a length
  std::int64_t cells_[3]{};          ///< along a periodic axis; 0 along others
  std::vector<std::int32_t> first_;  ///< the table, a power of two: a point of each list
  std::vector<Link> links_;          ///< by id
};

template <class Look>
void CloseGrid::for_each_near(Vec3 at, double reach, const Look& look) const {
  constexpr double kRounding = 0x1p-20;  // of coordinates in cells, which 2^-23 bounds
  std::int64_t low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double within = (reach * (1 + kRounding) + slack_) * per_length_[axis] + kRounding;
    const double middle = in_cells(at, axis);
    low[axis] = static_cast<std::int64_t>(std::floor(middle - within));
    high[axis] = static_cast<std::int64_t>(std::floor(middle + within));
  }
  for (std::int64_t x = low[0]; x <= high[0]; ++x)
    for (std::int64_t y = low[1]; y <= high[1]; ++y)
      for (std::int64_t z = low[2]; z <= high[2]; ++z)
        for (std::int32_t id = first_[place_of({x, y, z})]; id != kNone;
             id = links_[static_cast<std::size_t>(id)].next)
          look(id);
}

}  // namespace dch::detail
