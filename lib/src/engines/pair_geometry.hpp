// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

#include "engines/cell_images.hpp"

namespace dch::detail {

/// Some pairs of one particle, side by side.
struct PairChunk {
  static constexpr int kMost = 128;
  template <class T>
  using Column = std::array<T, kMost>;

  std::array<Column<double>, 3> shift;              ///< S, whole numbers
  std::array<Column<double>, 3> displacement;       ///< D [length]
  std::array<Column<std::int64_t>, 3> whole_shift;  ///< by count_shifts()
  Column<double> distance;                          ///< by take_distances() [length]

  /// Shifts as integers, of the first `count` pairs.
  void count_shifts(int count);
  /// |D| of the first `count` pairs.
  void take_distances(int count);
};

/// Shifts and displacements of pairs within less than half the smallest height of the cell, as NeighborPairs
/// defines them: many at once, without a branch.
///
/// A fractional coordinate of D is at most |D| / height < 1/2, so the integers of the one image that near are
/// those that bring the fractional coordinates of x_j - x_i nearest to 0: rounded, along the reduced vectors,
/// whose heights these are.
class PairGeometry {
 public:
  /// @param home of the positions as given; all has to outlive this
  PairGeometry(Span<const Vec3> given, const HomeImages& home, const Box& box);

  /// Of the pairs of i with j[0] .. j[count - 1], at most PairChunk::kMost.
  void measure(std::int32_t i, const std::int32_t* j, int count, PairChunk& out) const;

 private:
  using Columns = std::array<PairChunk::Column<double>, 3>;

  static void differences(const Vec3* from, std::int32_t i, const std::int32_t* j, int count, Columns& out);
  void round_shifts(const Columns& home, int count, Columns& shift) const;
  void add_home_shifts(std::int32_t i, const std::int32_t* j, int count, Columns& shift) const;
  void add_cells(int count, const Columns& shift, Columns& displacement) const;

  const Vec3* given_;
  const HomeImages& home_;
  bool are_at_home_ = true;  ///< all positions as given
  bool is_periodic_, is_axis_parallel_ = true;
  std::array<Vec3, 3> dual_{};      ///< of the reduced vectors; 0 beyond the rank
  std::array<Vec3, 3> integers_{};  ///< of the reduced vectors in those of the cell
  std::array<Vec3, 3> cell_{};      ///< 0 along open axes
};

}  // namespace dch::detail
