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

/// One coordinate of all points: wraps it, and makes it relative to the center. Marks points not in the cell.
inline void measure_axis(const BrickCell& cell, int axis, double center, Lanes& at, Lanes& relative,
                         Masks& outside) {
  const double low = cell.low[axis], high = cell.high[axis];
  const double length = cell.length[axis], half = cell.half[axis];
  const Doubles zero{};
  for (int k = 0; k < kRegisters; ++k) {
    Doubles x = at[k];
    const Doubles above = x >= high ? x - length : x;
    x = x < low ? x + length : above;
    outside |= (x < low) | (x >= high);
    at[k] = x;
    const Doubles d = x - center;
    relative[k] = d - (d > half ? zero + length : zero) + (d < -half ? zero + length : zero);
  }
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
  Masks outside{};
  const double* p[kBlock];
  for (std::int32_t lane = 0; lane < kBlock; ++lane)  // empty lanes repeat the first point
    p[lane] = positions + 3 * static_cast<std::int64_t>(index[lane < count ? lane : 0]);
  for (int axis = 0; axis < 3; ++axis) {
    for (int lane = 0; lane < kBlock; ++lane) at[axis][lane / kWidth][lane % kWidth] = p[lane][axis];
    measure_axis(cell, axis, center[axis], at[axis], relative[axis], outside);
    out.low[axis] = least_of(relative[axis]);
    out.high[axis] = greatest_of(relative[axis]);
  }
  for (int k = 0; k < kRegisters; ++k)
    distance2[k] =
        relative[0][k] * relative[0][k] + relative[1][k] * relative[1][k] + relative[2][k] * relative[2][k];
  out.extent2 = greatest_of(distance2);
  out.uncovered = 0;
  for (std::int32_t lane = 0; out.extent2 > covered2 && lane < count; ++lane)
    out.uncovered += distance2[lane / kWidth][lane % kWidth] > covered2;
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < kRegisters; ++k) {
      const Floats rounded = __builtin_convertvector(relative[axis][k], Floats);
      __builtin_memcpy(offset + axis * kBlock + k * kWidth, &rounded, sizeof rounded);
    }
  }
  for (int lane = 0; lane < kBlock; ++lane)
    for (int axis = 0; axis < 3; ++axis) wrapped[3 * lane + axis] = at[axis][lane / kWidth][lane % kWidth];
  std::int64_t any_outside = 0;
  for (int lane = 0; lane < kWidth; ++lane) any_outside |= outside[lane];
  return any_outside == 0;
}

}  // namespace
}  // namespace dch::detail
