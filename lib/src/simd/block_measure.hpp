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
};

/// Takes the positions of `count` points of a block (3 numbers a point; `index` says which), wraps them into
/// the cell, writes the images to `wrapped` (3 numbers a slot) and their displacements from the center to
/// `offset` (kBlock numbers an axis); entries beyond `count` are overwritten. In double throughout, the same
/// as OrthorhombicMetric does it, so the same on every instruction set. Returns false, and nothing of use, if
/// a point lies more than a cell away.
using MeasureBlock = bool (*)(const BrickCell& cell, const double* positions, const std::int32_t* index,
                              std::int32_t count, const double* center, double covered2, double* wrapped,
                              float* offset, BlockExtremes& out);

MeasureBlock measure_block(InstructionSet set);

bool measure_block_portable(const BrickCell&, const double*, const std::int32_t*, std::int32_t, const double*,
                            double, double*, float*, BlockExtremes&);
#ifdef DCH_X86_KERNELS
bool measure_block_avx2(const BrickCell&, const double*, const std::int32_t*, std::int32_t, const double*,
                        double, double*, float*, BlockExtremes&);
bool measure_block_avx512(const BrickCell&, const double*, const std::int32_t*, std::int32_t, const double*,
                          double, double*, float*, BlockExtremes&);
#endif

}  // namespace dch::detail
