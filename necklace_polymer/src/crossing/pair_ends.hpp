// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include <dch/base/vec3.hpp>

namespace dch::necklace::detail {

/// Multiples of the three cell vectors.
using Image = std::array<std::int32_t, 3>;

/// Where a bead is, exactly: a position as given plus whole cell vectors as given.
struct ExactPoint {
  Vec3 given;
  Image image{};
};

/// Ends of two bonds P and Q at both ends of a step, in the order P's first and second, Q's first and second.
struct PairEnds {
  std::array<ExactPoint, 4> from, to;
  std::array<Vec3, 3> cell_from{}, cell_to{};
  /// Numbers of the beads, each bead's own in all pairs and steps: they break ties (exact_crossings.hpp).
  std::array<std::uint64_t, 4> beads{0, 1, 2, 3};
};

}  // namespace dch::necklace::detail
