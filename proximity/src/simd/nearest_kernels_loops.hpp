// SPDX-License-Identifier: MIT
//
// The loops of nearest_kernels.hpp, made once for each instruction set, which says how wide its vectors are
// and moves chosen lanes to the front. No function of a library is called, since one compiled for a wider set
// could then be linked into all.
#pragma once

#include <limits>

#include "simd/nearest_kernels.hpp"

namespace dch::detail {
namespace {

/// The loops with the vectors of a set:
///   Floats, Ints            of kLanes numbers
///   at_most(a, b)           a bit for each lane
///   equal(a, b)             the same
///   append(bits, a, b, to_a, to_b)
///                           moves the chosen lanes of two vectors to the front of what is stored, of which
///                           kLanes are overwritten; returns how many there are
template <class Set>
struct NearestLoops {
  using Floats = typename Set::Floats;
  using Ints = typename Set::Ints;
  static constexpr std::int32_t kLanes = Set::kLanes;
  static_assert(kChunk % kLanes == 0);

  template <class Vector, class Number>
  static Vector load(const Number* from) {
    Vector loaded;
    __builtin_memcpy(&loaded, from, sizeof loaded);
    return loaded;
  }
  template <class Vector, class Number>
  static Vector all(Number number) {
    return Vector{} + number;
  }
  static Ints numbers_from(std::int32_t first) {
    Ints numbers;
    for (std::int32_t lane = 0; lane < kLanes; ++lane) numbers[lane] = first + lane;
    return numbers;
  }

  static std::int32_t select(const BoxAndReach& box, const NearBlocks& blocks, std::int32_t count,
                             std::int32_t* block, float* gap2) {
    const auto reach2 = all<Floats>(box.reach2);
    Ints number = numbers_from(0);
    std::int32_t found = 0;
    for (std::int32_t first = 0; first < count; first += kLanes, number += kLanes) {
      Floats sum{};
      for (int axis = 0; axis < 3; ++axis) {
        const Floats below = load<Floats>(blocks.low[axis] + first) - box.high[axis],
                     above = box.low[axis] - load<Floats>(blocks.high[axis] + first);
        const Floats zero{}, outside = below > above ? below : above;
        const Floats gap = outside > zero ? outside : zero;
        sum += gap * gap;
      }
      std::uint32_t lanes = Set::at_most(sum, reach2);
      if (count - first < kLanes) lanes &= (1u << (count - first)) - 1;
      found += Set::append(lanes, sum, number, gap2 + found, block + found);
    }
    return found;
  }

  static std::int32_t gather(const std::int32_t* block, std::int32_t count, const NearBlocks& blocks,
                             const NearPoints& to) {
    std::int32_t points = 0;
    for (std::int32_t n = 0; n < count; ++n, points += kBlock) {
      const float* const from = blocks.coordinates + 3 * kBlock * static_cast<std::int64_t>(block[n]);
      for (int axis = 0; axis < 3; ++axis)
        __builtin_memcpy(to.at[axis] + points, from + axis * kBlock, kBlock * sizeof(float));
      for (std::int32_t lane = 0; lane < kBlock; ++lane) to.slot[points + lane] = block[n] * kBlock + lane;
    }
    for (; points % kChunk != 0; ++points) {
      for (float* const axis : to.at) axis[points] = std::numeric_limits<float>::infinity();
      to.slot[points] = -1;
    }
    return points;
  }

  static std::int32_t search(const NearestTask& task, const NearPoints& points, std::int32_t first,
                             std::int32_t last, NearestFound& found) {
    const auto x = all<Floats>(task.at[0]), y = all<Floats>(task.at[1]), z = all<Floats>(task.at[2]);
    const auto reach2 = all<Floats>(task.reach2);
    const Ints own = all<Ints>(task.own_slot);
    std::int32_t count = found.count;
    for (; first < last && count <= found.room - kLanes; first += kLanes) {
      const Floats dx = load<Floats>(points.at[0] + first) - x, dy = load<Floats>(points.at[1] + first) - y,
                   dz = load<Floats>(points.at[2] + first) - z;
      const Floats distance2 = dx * dx + dy * dy + dz * dz;
      const Ints slot = load<Ints>(points.slot + first);
      const std::uint32_t lanes = Set::at_most(distance2, reach2) & ~Set::equal(slot, own);
      count += Set::append(lanes, distance2, slot, found.distance2 + count, found.slot + count);
    }
    found.count = count;
    return first;
  }

  static void rank(const std::int32_t* key, std::int32_t count, std::int32_t* rank) {
    for (std::int32_t first = 0; first < count; first += kLanes) {
      const Ints keys = load<Ints>(key + first);
      Ints smaller{};
      for (std::int32_t n = 0; n < count; ++n) smaller -= all<Ints>(key[n]) < keys;
      __builtin_memcpy(rank + first, &smaller, sizeof smaller);
    }
  }

  static constexpr NearestKernels kKernels{select, gather, search, rank};
};

}  // namespace
}  // namespace dch::detail
