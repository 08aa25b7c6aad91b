// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

namespace LAMMPS_NS {

/// Ghosts of one type that the search does not have, by where they were when lists were made: in slabs along
/// the axis on which they lie farthest apart.
class GhostsLeftOut {
 public:
  /// O(n)
  /// @param ghosts  LAMMPS's indices
  /// @param x  positions by index [length]
  GhostsLeftOut(int type, dch::Span<const int> ghosts, const double* const* x);
  int type() const { return type_; }
  /// Whether `test` holds for one of them that was within `radius` of a place [length].
  template <class Test>
  bool any_near(dch::Vec3 place, double radius, const Test& test) const {
    const auto at = [&](std::size_t k) { return ghosts_.begin() + static_cast<std::ptrdiff_t>(k); };
    return std::any_of(at(first_[slab_of(place[axis_] - radius)]),
                       at(first_[slab_of(place[axis_] + radius) + 1]), [&](const Ghost& ghost) {
                         return norm2(ghost.before - place) <= radius * radius &&
                                test(ghost.index, ghost.before);
                       });
  }

 private:
  std::size_t slab_of(double coordinate) const;

  struct Ghost {
    dch::Vec3 before;
    int index;
  };
  std::vector<Ghost> ghosts_;       ///< by slab
  std::vector<std::size_t> first_;  ///< by slab; and one more, for the end of the last
  int type_, axis_ = 0;
  double low_ = 0, per_length_ = 0;  ///< of slabs
};

}  // namespace LAMMPS_NS
