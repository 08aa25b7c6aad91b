// SPDX-License-Identifier: MIT
//
// The loops of block_measure.hpp, for the compiler to vectorize: included once for each instruction set. No
// function of a library is called, since one compiled for a wider set could then be linked into all.
#pragma once

#include "simd/block_measure.hpp"
#include "simd/native_doubles.hpp"

namespace dch::detail {
namespace {

using Masks __attribute__((vector_size(kWidth * sizeof(double)))) = std::int64_t;
using Floats __attribute__((vector_size(kWidth * sizeof(float)))) = float;

/// A number for each point of a block, in as many registers as that takes.
inline constexpr int kRegisters = kBlock / kWidth;
using Lanes = Doubles[kRegisters];

/// One coordinate of all points: wraps it, and makes it relative to the center. Marks points not in the cell,
/// and those that are taken in another image than as given.
inline void measure_axis(const BrickCell& cell, int axis, double center, Lanes& at, Lanes& relative,
                         Masks& outside, Masks& moved) {
  const double low = cell.low[axis], high = cell.high[axis];
  const double length = cell.length[axis], half = cell.half[axis];
  const Doubles zero{};
  for (int k = 0; k < kRegisters; ++k) {
    Doubles x = at[k];
    const Masks is_above = x >= high, is_below = x < low;
    const Doubles above = is_above ? x - length : x;
    x = is_below ? x + length : above;
    outside |= (x < low) | (x >= high);
    at[k] = x;
    const Doubles d = x - center;
    moved |= is_above | is_below | (d > half) | (d < -half);
    relative[k] = d - (d > half ? zero + length : zero) + (d < -half ? zero + length : zero);
  }
}

/// One coordinate of the points of a block. Empty lanes repeat the first point.
class BlockLanes {
 public:
  BlockLanes(const double* positions, const std::int32_t* index, std::int32_t count) {
    for (std::int32_t lane = 0; lane < kBlock; ++lane) {
      const std::int32_t own = index[lane], first = index[0];
      p_[lane] = positions + 3 * static_cast<std::int64_t>(lane < count ? own : first);
    }
  }
  [[gnu::always_inline]] void load(int axis, Lanes& at) const {
    for (int lane = 0; lane < kBlock; ++lane) at[lane / kWidth][lane % kWidth] = p_[lane][axis];
  }

 private:
  const double* p_[kBlock];
};

inline void store_rounded(const Lanes& from, float* to) {
  for (int k = 0; k < kRegisters; ++k) {
    const Floats rounded = __builtin_convertvector(from[k], Floats);
    __builtin_memcpy(to + k * kWidth, &rounded, sizeof rounded);
  }
}

inline bool is_none(const Masks& outside) {
  std::int64_t any = 0;
  for (int lane = 0; lane < kWidth; ++lane) any |= outside[lane];
  return any == 0;
}

/// Reduces both halves of a block to one, and that to a number, in the same order with any width.
template <class Choose>
[[gnu::always_inline]] inline double reduce(const Lanes& v, const Choose& choose) {
  constexpr int kHalf = kBlock / 2, kPart = kWidth < kHalf ? kWidth : kHalf;
  using Part __attribute__((vector_size(kPart * sizeof(double)))) = double;
  double half[kHalf];
  for (int k = 0; k < kHalf; k += kPart) {
    Part a, b, chosen;
    __builtin_memcpy(&a, reinterpret_cast<const double*>(v) + k, sizeof a);
    __builtin_memcpy(&b, reinterpret_cast<const double*>(v) + kHalf + k, sizeof b);
    choose(a, b, chosen);
    __builtin_memcpy(half + k, &chosen, sizeof chosen);
  }
  double first, second, last;
  choose(half[0], half[1], first);
  choose(half[2], half[3], second);
  choose(first, second, last);
  return last;
}
inline double least_of(const Lanes& v) {
  return reduce(v, [](const auto& a, const auto& b, auto& least) { least = a < b ? a : b; });
}
inline double greatest_of(const Lanes& v) {
  return reduce(v, [](const auto& a, const auto& b, auto& greatest) { greatest = a > b ? a : b; });
}

inline bool measure_block_loops(const BrickCell& cell, const double* positions, const std::int32_t* index,
                                std::int32_t count, const double* center, double covered2, double* wrapped,
                                float* offset, BlockExtremes& out) {
  Lanes at[3], relative[3], distance2;
  Masks outside{}, moved{};
  const BlockLanes points(positions, index, count);
  for (int axis = 0; axis < 3; ++axis) {
    points.load(axis, at[axis]);
    measure_axis(cell, axis, center[axis], at[axis], relative[axis], outside, moved);
    out.low[axis] = least_of(relative[axis]);
    out.high[axis] = greatest_of(relative[axis]);
  }
  for (int k = 0; k < kRegisters; ++k)
    distance2[k] =
        relative[0][k] * relative[0][k] + relative[1][k] * relative[1][k] + relative[2][k] * relative[2][k];
  out.extent2 = greatest_of(distance2);
  out.is_plain = is_none(moved);
  out.uncovered = 0;
  for (std::int32_t lane = 0; out.extent2 > covered2 && lane < count; ++lane)
    out.uncovered += distance2[lane / kWidth][lane % kWidth] > covered2;
  for (int axis = 0; axis < 3 && offset != nullptr; ++axis)
    store_rounded(relative[axis], offset + axis * kBlock);
  for (int lane = 0; lane < kBlock && wrapped != nullptr; ++lane)
    for (int axis = 0; axis < 3; ++axis) wrapped[3 * lane + axis] = at[axis][lane / kWidth][lane % kWidth];
  return is_none(outside);
}

/// As rounded() does it: then the integer stands in the low bits.
inline void store_integers(const float* offset, float origin, float per_unit, std::int16_t* to) {
  constexpr int kAtOnce = 2 * kWidth < kBlock ? 2 * kWidth : kBlock;
  using Some __attribute__((vector_size(kAtOnce * sizeof(float)))) = float;
  using Bits __attribute__((vector_size(kAtOnce * sizeof(float)))) = std::int32_t;
  using Integers __attribute__((vector_size(kAtOnce * sizeof(std::int16_t)))) = std::int16_t;
  for (int lane = 0; lane < kBlock; lane += kAtOnce) {
    Some at;
    __builtin_memcpy(&at, offset + lane, sizeof at);
    const Some shifted = (at - origin) * per_unit + 0x1.8p23f;
    Bits bits;
    __builtin_memcpy(&bits, &shifted, sizeof bits);
    const Integers integers = __builtin_convertvector(bits, Integers);
    __builtin_memcpy(to + lane, &integers, sizeof integers);
  }
}

inline void round_block_loops(const double* positions, const std::int32_t* index, const double* center,
                              const BlockUnits& units, std::int16_t* rounded) {
  const double* p[kBlock];
  for (int lane = 0; lane < kBlock; ++lane)
    p[lane] = positions + 3 * static_cast<std::int64_t>(index[lane] < 0 ? 0 : index[lane]);
  for (int axis = 0; axis < 3; ++axis) {
    float offset[kBlock];
    for (int k = 0; k < kRegisters; ++k) {
      Doubles at;
      for (int lane = 0; lane < kWidth; ++lane) at[lane] = p[k * kWidth + lane][axis];
      const Floats near = __builtin_convertvector(at - center[axis], Floats);
      __builtin_memcpy(offset + k * kWidth, &near, sizeof near);
    }
    store_integers(offset, units.origin[axis], units.per_unit, rounded + axis * kBlock);
  }
}

inline bool offset_block_loops(const BrickCell& cell, const double* positions, const std::int32_t* index,
                               std::int32_t count, const double* center, float* offset) {
  Lanes at[3], relative;
  Masks outside{}, moved{};
  const BlockLanes points(positions, index, count);
  for (int axis = 0; axis < 3; ++axis) {
    points.load(axis, at[axis]);
    measure_axis(cell, axis, center[axis], at[axis], relative, outside, moved);
    store_rounded(relative, offset + axis * kBlock);
  }
  return is_none(outside);
}

}  // namespace
}  // namespace dch::detail
