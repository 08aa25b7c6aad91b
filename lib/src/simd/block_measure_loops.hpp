// SPDX-License-Identifier: MIT
//
// The loops of block_measure.hpp, for the compiler to vectorize: included once for each instruction set. No
// function of a library is called, since one compiled for a wider set could then be linked into all.
#pragma once

#include "simd/block_measure.hpp"

namespace dch::detail {
namespace {

/// A number for each point of a block: a vector of the compiler's, in as many registers as that takes.
using Lanes __attribute__((vector_size(kBlock * sizeof(double)))) = double;
using HalfLanes __attribute__((vector_size(kBlock / 2 * sizeof(double)))) = double;
using Mask __attribute__((vector_size(kBlock * sizeof(std::int64_t)))) = std::int64_t;
using FloatLanes __attribute__((vector_size(kBlock * sizeof(float)))) = float;

/// One coordinate of all points: wraps it, and makes it relative to the center. Marks points not in the cell.
inline void measure_axis(const BrickCell& cell, int axis, double center, Lanes& x, Lanes& relative,
                         Mask& outside) {
  const double low = cell.low[axis], high = cell.high[axis];
  const double length = cell.length[axis], half = cell.half[axis];
  const Lanes zero{};
  const Lanes above = x >= high ? x - length : x;
  x = x < low ? x + length : above;
  outside |= (x < low) | (x >= high);
  const Lanes d = x - center;
  relative = d - (d > half ? zero + length : zero) + (d < -half ? zero + length : zero);
}

inline void halves_of(const Lanes& v, HalfLanes& a, HalfLanes& b) {
  __builtin_memcpy(&a, &v, sizeof a);
  __builtin_memcpy(&b, reinterpret_cast<const char*>(&v) + sizeof a, sizeof b);
}
inline double least_of(const Lanes& v) {
  HalfLanes a, b;
  halves_of(v, a, b);
  const HalfLanes least = a < b ? a : b;
  const double first = least[0] < least[1] ? least[0] : least[1];
  const double second = least[2] < least[3] ? least[2] : least[3];
  return first < second ? first : second;
}
inline double greatest_of(const Lanes& v) {
  HalfLanes a, b;
  halves_of(v, a, b);
  const HalfLanes greatest = a > b ? a : b;
  const double first = greatest[0] > greatest[1] ? greatest[0] : greatest[1];
  const double second = greatest[2] > greatest[3] ? greatest[2] : greatest[3];
  return first > second ? first : second;
}

inline bool measure_block_loops(const BrickCell& cell, const double* positions, const std::int32_t* index,
                                std::int32_t count, const double* center, double covered2, double* wrapped,
                                float* offset, BlockExtremes& out) {
  Lanes at[3], relative[3];
  Mask outside{};
  const double* p[kBlock];
  for (std::int32_t lane = 0; lane < kBlock; ++lane)  // empty lanes repeat the first point
    p[lane] = positions + 3 * static_cast<std::int64_t>(index[lane < count ? lane : 0]);
  for (int axis = 0; axis < 3; ++axis)
    at[axis] =
        Lanes{p[0][axis], p[1][axis], p[2][axis], p[3][axis], p[4][axis], p[5][axis], p[6][axis], p[7][axis]};
  for (int axis = 0; axis < 3; ++axis) {
    measure_axis(cell, axis, center[axis], at[axis], relative[axis], outside);
    out.low[axis] = least_of(relative[axis]);
    out.high[axis] = greatest_of(relative[axis]);
  }
  const Lanes distance2 = relative[0] * relative[0] + relative[1] * relative[1] + relative[2] * relative[2];
  out.extent2 = greatest_of(distance2);
  out.uncovered = 0;
  for (std::int32_t lane = 0; out.extent2 > covered2 && lane < count; ++lane)
    out.uncovered += distance2[lane] > covered2;
  for (int axis = 0; axis < 3; ++axis) {
    const FloatLanes rounded = __builtin_convertvector(relative[axis], FloatLanes);
    __builtin_memcpy(offset + axis * kBlock, &rounded, sizeof rounded);
  }
  std::int64_t any_outside = 0;
  for (int lane = 0; lane < kBlock; ++lane) {
    any_outside |= outside[lane];
    for (int axis = 0; axis < 3; ++axis) wrapped[3 * lane + axis] = at[axis][lane];
  }
  return any_outside == 0;
}

}  // namespace
}  // namespace dch::detail
