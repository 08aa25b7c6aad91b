// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#include "hierarchy/leaf_blocks.hpp"
#include "hierarchy/level.hpp"

namespace dch::detail {

/// The leaves (nodes of level 1 with their points) as they are measured at each update: the points relative
/// to the center of their leaf, in blocks with a box around each. The blocks of a leaf lie side by side. The
/// structure alone writes this; lists are made from it.
struct MeasuredLeaves {
  struct Leaf {
    std::int32_t first_block = 0, blocks = 0;
    double extent = 0;       ///< distance of the farthest point from the center [length]
    double width = 0;        ///< of the box around the points and the center, along its longest side [length]
    Vec3 middle;             ///< of that box, relative to the center [length]
    double block_width = 0;  ///< the same of the widest block
    std::int32_t uncovered = 0;  ///< points farther from the center than asked
  };
  /// Positions of a block's points relative to the leaf's center [length].
  struct Offsets {
    float axis[3][kBlock];
  };
  /// The box around them [length].
  struct Corners {
    float low[3], high[3];
  };

  /// To be called when points have come, gone or changed their leaf, slot or id.
  void forget_layout() { layout = 0; }

  /// Takes the positions. To be called again when a point has moved, come or gone. Counts those whose squared
  /// distance from their center exceeds `covered2`.
  template <class Metric>
  void measure(const Metric& metric, const Level& centers, LeafBlocks& from, double covered2,
               Executor* executor);

  /// The same after motion, with the new positions, by id: wraps them into their slots too, in the same pass.
  /// Those of the centers are up to date already.
  template <class Metric>
  void refresh(const Metric& metric, const Level& centers, Span<const Vec3> positions, LeafBlocks& into,
               double covered2, Executor* executor);

  std::size_t memory_bytes() const;

  std::vector<Leaf> leaves;  ///< by node of level 1
  std::int32_t blocks = 0;
  std::vector<std::int32_t> source;  ///< by block: the block of LeafBlocks
  bool are_in_order = false;  ///< whether that is the same one for all, where LeafBlocks keeps no positions
  std::vector<std::uint8_t> count;      ///< by block: number of points
  std::vector<std::uint8_t> lanes;      ///< by block: a bit for each of them
  std::vector<std::uint8_t> are_plain;  ///< by block: BlockExtremes::is_plain
  std::vector<Offsets> offsets;  ///< by block; empty unless LeafBlocks keeps positions: see BlockOffsets
  std::vector<Corners> corners;  ///< by block
  double largest_extent = 0;     ///< of a leaf
  double largest_width = 0;
  double largest_block_width = 0;
  /// Another number whenever points may lie in other blocks, of this object or of another one; 0 if that is
  /// to be found out yet.
  std::uint64_t layout = 0;

 private:
  void lay_out(const Level& centers, const LeafBlocks& from);
  template <class Metric>
  void measure_all(const Metric& metric, const Level& centers, const Vec3* positions, LeafBlocks& from,
                   double covered2, Executor* executor);
  template <class Meter>
  void measure_leaf(const Meter& meter, Vec3 center, Leaf& leaf);
};

}  // namespace dch::detail
