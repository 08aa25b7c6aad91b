// SPDX-License-Identifier: MIT
#pragma once

#include <dch/necklace/cage_hierarchy.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

struct LayeredParams {
  int leaf_beads = 8;  ///< as WrappedParams::leaf_beads
};

/// The layered hierarchy (thesis 4.4.1): the cage of a node is the minimum ball around its children's cages,
/// that of a leaf the minimum ball of its beads. Cages nest, and an update costs O(n); but they are larger
/// than those of the wrapped hierarchy, by up to sqrt(ceil(lg n)) for beads of equal radii (Theorem 4.4.1,
/// where tight_set() comes to sqrt(lg n)), and by up to sqrt(ceil(lg n) + 1) for any.
class LayeredHierarchy : public CageHierarchy {
 public:
  /// @throws InvalidParameter unless 1 <= leaf_beads <= 64.
  explicit LayeredHierarchy(Necklace necklace, const LayeredParams& params = {});

  /// Makes all cages for these positions.
  /// @throws as WrappedHierarchy::build(); the hierarchy is empty then.
  void update(Span<const Vec3> positions, const Box& box);
};

}  // namespace dch::necklace
#pragma GCC visibility pop
