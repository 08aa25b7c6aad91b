// SPDX-License-Identifier: MIT
//
// The loops of nearest_kernels.hpp, for the compiler to vectorize: included once for each instruction set. No
// function of a library is called, since one compiled for a wider set could then be linked into all.
#pragma once

#include "simd/nearest_kernels.hpp"

namespace dch::detail {
namespace {

using FloatLanes __attribute__((vector_size(kBlock * sizeof(float)))) = float;
using LaneMask __attribute__((vector_size(kBlock * sizeof(std::int32_t)))) = std::int32_t;

// Vectors are handed on by reference: how they are returned depends on the set.
inline void load(const float* from, FloatLanes& to) { __builtin_memcpy(&to, from, sizeof to); }
inline void subtract(const float* from, float what, FloatLanes& to) {
  load(from, to);
  to -= what;
}
inline bool any(const LaneMask& mask) {
  std::uint64_t words[kBlock / 2];
  __builtin_memcpy(words, &mask, sizeof words);
  return (words[0] | words[1] | words[2] | words[3]) != 0;
}

inline std::int32_t select_blocks(const BoxAndReach& box, const NearBlocks& blocks, std::int32_t count,
                                  std::int32_t* block, float* gap2) {
  std::int32_t found = 0;
  for (std::int32_t first = 0; first < count; first += kBlock) {
    FloatLanes sum{};
    for (int axis = 0; axis < 3; ++axis) {
      FloatLanes below, above;
      subtract(blocks.low[axis] + first, box.high[axis], below);
      subtract(blocks.high[axis] + first, box.low[axis], above);
      const FloatLanes zero{}, outside = below > -above ? below : -above;
      const FloatLanes gap = outside > zero ? outside : zero;
      sum += gap * gap;
    }
    if (!any(sum <= box.reach2)) continue;
    for (std::int32_t lane = 0; lane < kBlock; ++lane) {
      block[found] = first + lane;
      gap2[found] = sum[lane];
      found += (sum[lane] <= box.reach2) & (first + lane < count);
    }
  }
  return found;
}

/// Squared distance of a point from the box of a block.
inline float gap2_of(const float at[3], const NearBlocks& blocks, std::int32_t block) {
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float below = blocks.low[axis][block] - at[axis], above = at[axis] - blocks.high[axis][block];
    const float outside = below > above ? below : above, gap = outside > 0 ? outside : 0;
    sum += gap * gap;
  }
  return sum;
}

/// Adds a candidate in its place. Returns the squared distance that others must have now at most.
inline float take_candidate(const NearestTask& task, float distance2, std::int32_t slot, float limit,
                            NearestFound& found) {
  if (found.count == task.room) {
    found.is_full = true;
    return limit;
  }
  std::int32_t place = found.count++;
  for (; place > 0 && found.distance2[place - 1] > distance2; --place) {
    found.distance2[place] = found.distance2[place - 1];
    found.slot[place] = found.slot[place - 1];
  }
  found.distance2[place] = distance2;
  found.slot[place] = slot;
  if (found.count < task.k) return limit;
  const float of_last = found.distance2[task.k - 1] * (1 + kBlur) + task.blur;
  if (of_last >= limit) return limit;
  while (found.distance2[found.count - 1] > of_last) --found.count;
  return of_last;
}

inline void search_blocks(const NearestTask& task, const NearBlocks& blocks, NearestFound& found) {
  found.count = found.blocks_seen = found.points_seen = 0;
  found.is_full = false;
  float limit = task.reach2;
  for (std::int32_t n = 0; n < task.blocks && task.gap2[n] <= limit && !found.is_full; ++n) {
    const std::int32_t block = task.block[n];
    ++found.blocks_seen;
    if (gap2_of(task.at, blocks, block) > limit) continue;
    const float* const points = blocks.coordinates + 3 * kBlock * static_cast<std::int64_t>(block);
    FloatLanes x, y, z;
    subtract(points, task.at[0], x);
    subtract(points + kBlock, task.at[1], y);
    subtract(points + 2 * kBlock, task.at[2], z);
    const FloatLanes distance2 = x * x + y * y + z * z;
    found.points_seen += blocks.count[block];
    if (!any(distance2 <= limit)) continue;
    for (std::int32_t lane = 0; lane < blocks.count[block]; ++lane) {
      const std::int32_t slot = block * kBlock + lane;
      if (distance2[lane] > limit || slot == task.own_slot || found.is_full) continue;
      limit = take_candidate(task, distance2[lane], slot, limit, found);
    }
  }
}

}  // namespace
}  // namespace dch::detail
