// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include <dch/necklace/cage_hierarchy.hpp>

#include "chains/bead_check.hpp"

namespace dch::necklace {

CageHierarchy::CageHierarchy(Necklace necklace, int leaf_beads)
    : necklace_(std::move(necklace)), trees_(necklace_, leaf_beads) {}

void CageHierarchy::take(Span<const Vec3> positions, const Box& box, std::vector<double>* moved2) {
  try {
    double largest = detail::check_positions(necklace_, positions);
    std::vector<Vec3> whole;
    if (box.any_periodic()) {
      whole = unwrap(necklace_.chains(), positions, box);
      largest = std::max(largest, detail::check_positions(necklace_, whole));
    }
    const Span<const Vec3> placed = whole.empty() ? positions : Span<const Vec3>(whole);
    place_beads(positions, placed, moved2);
    // A few roundings of each coordinate, and of its image.
    rounding_ = 1e-15 * (largest + necklace_.largest_radius());
    cages_.resize(trees_.nodes().size());
    box_ = box;
  } catch (...) {
    forget();
    throw;
  }
}

void CageHierarchy::forget() {
  beads_.clear();
  positions_.clear();
  cages_.clear();
}

void CageHierarchy::place_beads(Span<const Vec3> positions, Span<const Vec3> placed,
                                std::vector<double>* moved2) {
  const auto particles = necklace_.particle();
  const double* const radius = necklace_.radii().data();
  beads_.resize(particles.size());
  positions_.resize(particles.size());
  if (moved2 != nullptr) moved2->resize(particles.size());
  double* const moved = moved2 != nullptr ? moved2->data() : nullptr;
  for (std::size_t place = 0; place < particles.size(); ++place) {
    const auto k = static_cast<std::size_t>(particles[place]);
    const Vec3 now = placed[k];
    Ball& bead = beads_[place];
    if (moved != nullptr) moved[place] = norm2(now - bead.center);
    bead = {now, radius[k]};
    positions_[place] = positions[k];
  }
}

std::size_t CageHierarchy::memory_bytes() const {
  return (beads_.capacity() + cages_.capacity()) * sizeof(Ball) + positions_.capacity() * sizeof(Vec3) +
         trees_.nodes().size() * sizeof(ChainTrees::Node);
}

}  // namespace dch::necklace
