// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/vec3.hpp>

namespace dch::detail {

/// A point of a leaf, to be put in order.
struct LocalPoint {
  float at[3];         ///< relative to the leaf's center [length]
  std::int32_t index;  ///< the caller's
};

inline LocalPoint local_point(Vec3 at, std::int32_t index) {
  return {{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)}, index};
}

/// Blocks that `count` points fill.
std::int32_t blocks_for(std::int32_t count);

/// Points in the first `block` of `blocks` blocks, which take nearly the same number each.
std::int32_t share_of_blocks(std::int32_t count, std::int32_t blocks, std::int32_t block);

/// Orders points so that the blocks that share_of_blocks() cuts them into are the leaves of a k-d tree: the
/// longest side of the box around them is halved again and again.
void order_by_halving(LocalPoint* points, std::int32_t count);

/// The same down to leaves of four points, all of them full but the last.
void order_by_fours(LocalPoint* points, std::int32_t count);

}  // namespace dch::detail
