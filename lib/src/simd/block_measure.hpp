// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

#include <dch/base/instruction_set.hpp>

#include "simd/list_kernels.hpp"

namespace dch::detail {

/// A cell whose sides are parallel to the axes, as Box::wrap and OrthorhombicMetric see it [length].
struct BrickCell {
  static constexpr double kOpen = std::numeric_limits<double>::infinity();
  double low[3] = {-kOpen, -kOpen, -kOpen}, high[3] = {kOpen, kOpen, kOpen};  ///< corners
  double length[3] = {0, 0, 0};                                               ///< 0 along open axes
  double half[3] = {kOpen, kOpen, kOpen};                                     ///< of the length
};

/// The points of a block relative to a center, in double [length].
struct BlockExtremes {
  double low[3], high[3];  ///< corners of the box around them
  double extent2;          ///< squared distance of the farthest
  std::int32_t uncovered;  ///< number of those farther than asked
  bool
      is_plain;  ///< whether all offsets are the positions as given less the center: no image had to be found
};

/// Takes the positions of `count` points of a block (3 numbers a point; `index` says which: kBlock numbers,
/// whatever those beyond `count` are), wraps them into the cell, writes the images to `wrapped` (3 numbers a
/// slot) and their displacements from the center to `offset` (kBlock numbers an axis), each unless it is
/// null; entries beyond `count` are overwritten. In double throughout, the same as OrthorhombicMetric does
/// it, so the same on every instruction set. Returns false, and nothing of use, if a point lies more than a
/// cell away.
using MeasureBlock = bool (*)(const BrickCell& cell, const double* positions, const std::int32_t* index,
                              std::int32_t count, const double* center, double covered2, double* wrapped,
                              float* offset, BlockExtremes& out);

/// The displacements alone, the same numbers.
using OffsetBlock = bool (*)(const BrickCell& cell, const double* positions, const std::int32_t* index,
                             std::int32_t count, const double* center, float* offset);

/// What the coordinates of offsets become: 16-bit integers.
struct BlockUnits {
  float origin[3];  ///< of a leaf, relative to its center [length]
  float per_unit;   ///< [1/length]
};

/// The displacements of a block that is_plain, as the nearest integers to (offset - origin) * per_unit, in
/// float, modulo 2^16: kBlock numbers an axis. Negative numbers of `index` say that there is no point.
using RoundBlock = void (*)(const double* positions, const std::int32_t* index, const double* center,
                            const BlockUnits& units, std::int16_t* rounded);

MeasureBlock measure_block(InstructionSet set);
OffsetBlock offset_block(InstructionSet set);
RoundBlock round_block(InstructionSet set);

bool measure_block_portable(const BrickCell&, const double*, const std::int32_t*, std::int32_t, const double*,
                            double, double*, float*, BlockExtremes&);
bool offset_block_portable(const BrickCell&, const double*, const std::int32_t*, std::int32_t, const double*,
                           float*);
void round_block_portable(const double*, const std::int32_t*, const double*, const BlockUnits&,
                          std::int16_t*);
#ifdef DCH_X86_KERNELS
bool measure_block_avx2(const BrickCell&, const double*, const std::int32_t*, std::int32_t, const double*,
                        double, double*, float*, BlockExtremes&);
bool measure_block_avx512(const BrickCell&, const double*, const std::int32_t*, std::int32_t, const double*,
                          double, double*, float*, BlockExtremes&);
bool offset_block_avx2(const BrickCell&, const double*, const std::int32_t*, std::int32_t, const double*,
                       float*);
void round_block_avx2(const double*, const std::int32_t*, const double*, const BlockUnits&, std::int16_t*);
bool offset_block_avx512(const BrickCell&, const double*, const std::int32_t*, std::int32_t, const double*,
                         float*);
void round_block_avx512(const double*, const std::int32_t*, const double*, const BlockUnits&, std::int16_t*);
#endif

}  // namespace dch::detail
