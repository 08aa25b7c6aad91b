// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>

#include "hierarchy/structure.hpp"
#include "leaves/block_offsets.hpp"
#include "lists/unlisted_pairs.hpp"

namespace dch::detail {

/// Finds the points of a hierarchy that lie in a crescent, as they were when it was last brought up to date.
/// Leaves and blocks that lie all inside the inner sphere or outside the outer one are passed over.
template <class Metric>
class LeafCrescents {
 public:
  /// @param structure measured
  LeafCrescents(const Metric& metric, const Structure& structure);

  /// The leaf of a point, kNone if it is in none.
  std::int32_t leaf_of(std::int32_t id) const {
    return structure_.is_singleton_point(id) ? kNone : structure_.lowest_node(id).node;
  }

  /// Whether `test(id)` is true of a point in the crescent; it is asked about a few more. No order is
  /// promised.
  /// @param own leaf of a point near the crescent's middle, whose edges are looked at if they are certified
  ///   to reach far enough; kNone for a descent from the roots
  using Test = std::function<bool(std::int32_t id)>;
  bool any(const Crescent& crescent, std::int32_t own, const Test& test) const;

 private:
  bool edges_reach(const Crescent& crescent, std::int32_t own) const;
  bool any_below(const Crescent& crescent, int level, std::int32_t node, double reach,
                 const Test& test) const;
  bool any_in_leaf(const Crescent& crescent, std::int32_t leaf, const Test& test) const;
  bool is_near(const Crescent& crescent, Vec3 wrapped) const;
  bool any_image(const Crescent& crescent, std::int32_t block, const Test& test) const;

  const Metric& metric_;
  const Structure& structure_;
  BlockOffsets<Metric> offsets_;
  double motion_;  ///< of nodes of level 1 since parents were in order, at most [length]
  double others_;  ///< how far from its center, where edges were made, a leaf's points may be [length]
  double singletons_ =
      0;             ///< how much farther than coverage says a singleton may be from its parent [length]
  double shortest_;  ///< period of the box [length]
};

}  // namespace dch::detail
