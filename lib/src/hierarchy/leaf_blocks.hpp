// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/index_count.hpp>
#include <dch/base/vec3.hpp>

#include "hierarchy/level.hpp"
#include "simd/list_kernels.hpp"

namespace dch::detail {

/// Blocks whose slots 32-bit indices name: room for 2^31 - 8 points in full blocks, for 2^28 - 1 wherever
/// they are.
inline constexpr std::int64_t kMaxBlocks = kMaxIndexCount / kBlock;

/// The same number.
/// @param most fewer than kMaxBlocks in tests alone
/// @throws InvalidParameter for more blocks than that.
inline std::int32_t block_count(std::int64_t blocks, std::int64_t most = kMaxBlocks) {
  return index_count(blocks, "blocks of eight points (one or more for each leaf)", "take fewer points", most);
}

/// Level S_0: the points, in blocks of kBlock slots. The points of one leaf (a node of level 1, their
/// parent) fill a chain of blocks of their own, each from its first slot on, so that lists can be made of
/// whole blocks; reorder() puts points that are close together into one block. However long a chain is, a
/// block enters or leaves it in a few steps.
struct LeafBlocks {
  bool keeps_positions = true;      ///< StructureParams::keeps_block_positions
  std::vector<Vec3> position;       ///< by slot; wrapped into the cell; empty if they are not kept
  std::vector<std::int32_t> id;     ///< by slot; the caller's name of the point, kNone in an empty slot
  std::vector<std::int32_t> leaf;   ///< by block: the parent of its points, kNone for a block not in use
  std::vector<std::int32_t> next;   ///< by block: the next one of its leaf, or kNone
  std::vector<std::int32_t> prev;   ///< by block: the one before it; of the first block of a chain the last
  std::vector<std::int32_t> count;  ///< by block: points in it
  std::vector<std::int32_t> free;   ///< blocks not in use
  std::int32_t alive = 0;           ///< number of points
  std::int64_t most = kMaxBlocks;   ///< blocks; fewer in tests, which refuse some without 2^28 of them

  std::int32_t size() const { return static_cast<std::int32_t>(id.size()); }
  std::int32_t parent(std::int32_t slot) const { return leaf[slot / kBlock]; }

  /// Makes room for that many blocks in all.
  void reserve(std::int32_t blocks) {
    const auto room = static_cast<std::size_t>(blocks);
    for (auto* array : {&leaf, &next, &prev, &count}) array->reserve(room);
    if (keeps_positions) position.reserve(room * kBlock);
    id.reserve(room * kBlock);
  }

  /// Where there is none: for few blocks in an engine, of which repairs take some, else for as many again.
  void make_room_for_one() {
    const auto blocks = static_cast<std::int64_t>(leaf.size()) + 1;
    if (static_cast<std::int64_t>(leaf.capacity()) >= blocks) return;
    constexpr std::int64_t kLeast = 8;
    const std::int64_t more = keeps_positions ? blocks : blocks / 16;
    reserve(static_cast<std::int32_t>(std::min(blocks + more + kLeast, kMaxBlocks)));
  }

  /// A block with no points yet: a chain of its own.
  /// @throws InvalidParameter for more blocks than `most`.
  std::int32_t add_block(std::int32_t owner) {
    std::int32_t block;
    if (free.empty()) {
      block = block_count(static_cast<std::int64_t>(leaf.size()) + 1, most) - 1;
      make_room_for_one();
      leaf.push_back(kNone);
      next.push_back(kNone);
      prev.push_back(kNone);
      count.push_back(0);
      if (keeps_positions) position.resize(position.size() + kBlock);
      id.resize(id.size() + kBlock, kNone);
    } else {
      block = free.back();
      free.pop_back();
    }
    leaf[block] = owner;
    next[block] = kNone;
    prev[block] = block;
    return block;
  }
  /// Puts the chain that begins with `more` at the end of another one.
  void append(std::int32_t& first, std::int32_t more) {
    if (more == kNone) return;
    if (first == kNone) {
      first = more;
      return;
    }
    const std::int32_t last = prev[first];
    next[last] = more;
    prev[first] = prev[more];
    prev[more] = last;
  }
  /// Takes a block out of its chain, to be one of its own.
  void unlink(std::int32_t& first, std::int32_t block) {
    const std::int32_t after = next[block], before = prev[block];
    if (after != kNone || block != first) prev[after == kNone ? first : after] = before;
    (block == first ? first : next[before]) = after;
    next[block] = kNone;
    prev[block] = block;
  }
  /// Makes the second block of a chain the first one, and the first one the last.
  void turn(std::int32_t& first) {
    const std::int32_t last = prev[first], block = first;
    if (last == block) return;
    first = next[block];
    next[last] = block;
    next[block] = kNone;
  }
  void give_to(std::int32_t owner, std::int32_t first) {
    for (std::int32_t block = first; block != kNone; block = next[block]) leaf[block] = owner;
  }
  /// Gives up a block that has been taken out of its chain.
  void free_block(std::int32_t block) {
    alive -= count[block];
    for (std::int32_t lane = 0; lane < kBlock; ++lane) id[block * kBlock + lane] = kNone;
    leaf[block] = kNone;
    count[block] = 0;
    free.push_back(block);
  }
  std::int32_t push(std::int32_t block, std::int32_t point, Vec3 at) {
    const std::int32_t slot = block * kBlock + count[block]++;
    if (keeps_positions) position[slot] = at;
    id[slot] = point;
    ++alive;
    return slot;
  }

  /// Has the positions by id of the points of a block fetched, which is to be looked at soon: they lie
  /// anywhere. For all lanes, without a branch: that of a lane without a point is the place before the first
  /// one.
  void ask_for(std::int32_t block, const Vec3* positions) const {
    const std::int32_t* const point = id.data() + static_cast<std::size_t>(block) * kBlock;
    const auto from = reinterpret_cast<std::intptr_t>(positions);
    for (int lane = 0; lane < kBlock; ++lane) {
      const auto place = std::intptr_t{point[lane]} * static_cast<std::intptr_t>(sizeof(Vec3));
      __builtin_prefetch(reinterpret_cast<const void*>(from + place));  // NOLINT(performance-no-int-to-ptr)
    }
  }

  /// Puts the point of another slot into this one.
  void copy_point(std::int32_t from, std::int32_t to) {
    if (keeps_positions) position[to] = position[from];
    id[to] = id[from];
  }

  /// Calls f(slot) for the points of the chain that begins with `block`.
  template <class F>
  void for_each(std::int32_t block, const F& f) const {
    for (; block != kNone; block = next[block])
      for (std::int32_t lane = 0; lane < count[block]; ++lane) f(block * kBlock + lane);
  }

  /// Keeps the memory, for the next build.
  void clear() {
    position.clear();
    for (auto* array : {&id, &leaf, &next, &prev, &count, &free}) array->clear();
    alive = 0;
  }
  std::size_t memory_bytes() const {
    return position.capacity() * sizeof(Vec3) + (id.capacity() + leaf.capacity() + next.capacity() +
                                                 prev.capacity() + count.capacity() + free.capacity()) *
                                                    sizeof(std::int32_t);
  }
};

}  // namespace dch::detail
