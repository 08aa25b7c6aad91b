// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include <dch/necklace/cage_hierarchy.hpp>

#include "bead_check.hpp"

namespace dch::necklace {

CageHierarchy::CageHierarchy(Necklace necklace, int leaf_beads)
    : necklace_(std::move(necklace)), trees_(necklace_, leaf_beads) {}

void CageHierarchy::take(Span<const Vec3> positions, const Box& box) {
  beads_.clear();
  positions_.clear();
  try {
    detail::check_positions(necklace_, positions);
    std::vector<Vec3> whole;
    if (box.any_periodic()) whole = unwrap(necklace_.chains(), positions, box);
    const Span<const Vec3> placed = whole.empty() ? positions : Span<const Vec3>(whole);
    double largest = 0;
    for (const std::int32_t particle : necklace_.particle()) {
      const auto k = static_cast<std::size_t>(particle);
      beads_.push_back({placed[k], necklace_.radii()[k]});
      positions_.push_back(positions[k]);
      for (int axis = 0; axis < 3; ++axis) {
        largest = std::max({largest, std::abs(placed[k][axis]), std::abs(positions[k][axis])});
      }
    }
    // A few roundings of each coordinate, and of its image.
    rounding_ = 1e-15 * (largest + necklace_.largest_radius());
    cages_.resize(trees_.nodes().size());
    box_ = box;
  } catch (...) {
    beads_.clear();
    positions_.clear();
    cages_.clear();
    throw;
  }
}

std::size_t CageHierarchy::memory_bytes() const {
  return (beads_.capacity() + cages_.capacity()) * sizeof(Ball) + positions_.capacity() * sizeof(Vec3) +
         trees_.nodes().size() * sizeof(ChainTrees::Node);
}

}  // namespace dch::necklace
