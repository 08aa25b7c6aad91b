// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <dch/geometry/box.hpp>
#include <dch/lists/neighbor_list.hpp>

namespace dch::hard {

/// Distances of all pairs in long double, with all images that could be near enough; shares no code with the
/// library, nor with its oracle.
class LongDoublePairs {
 public:
  /// Images farther away than `radius` may be left out.
  LongDoublePairs(const std::vector<Vec3>& positions, const Box& box, double radius);

  /// Of the nearest images; infinity if it exceeds the radius [length].
  long double distance(std::size_t i, std::size_t j) const;
  /// How far double precision may put that distance off, computed from the positions and the cell vectors as
  /// given [length].
  long double rounding(std::size_t i, std::size_t j) const;

 private:
  using LongVec = std::array<long double, 3>;
  void invert_gram();

  const std::vector<Vec3>& positions_;
  long double radius_;
  std::vector<LongVec> period_, dual_;  ///< periodic cell vectors, and the dual basis in their span
  long double cell_size_ = 0, skew_ = 1;
};

/// What a half list of all pairs within the radius has wrong, and how many pairs there are.
struct PairComparison {
  std::int64_t pairs = 0;     ///< in the list
  std::int64_t in_doubt = 0;  ///< so near the radius that double precision may put them on either side
  std::int64_t missing = 0;   ///< within the radius for sure
  std::int64_t too_many = 0;  ///< beyond it for sure

  bool is_right() const { return missing == 0 && too_many == 0; }
  PairComparison& operator+=(const PairComparison& other);
  std::string text() const;
};

PairComparison compare_pairs(const NeighborList& list, const std::vector<Vec3>& positions, const Box& box,
                             double radius);

}  // namespace dch::hard
