// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/instruction_set.hpp>

#include "simd/list_kernels.hpp"

namespace dch::detail {

/// How points of a box with sides along the axes are put into bins and rounded. Each array has a number for
/// each coordinate of kBlock points that follow each other: that of x, y, z, x, and so on.
struct alignas(64) BrickBins {
  static constexpr int kNumbers = 3 * kBlock;
  double low[kNumbers], high[kNumbers], length[kNumbers];  ///< of the box; infinite and 0 along open axes
  /// Bin = (wrapped coordinate - origin) * per_bin, not below least, not above most, rounded down.
  double origin[kNumbers], per_bin[kNumbers], least[kNumbers], most[kNumbers];
  /// Rounded coordinate = (wrapped coordinate - zero) * per_unit.
  double zero[kNumbers], per_unit[kNumbers];
};

/// Wraps `count` points (3 numbers a point) into the box, and writes their bins and their rounded
/// coordinates, modulo 2^16, 3 numbers a point each. In double throughout, the same as OrthorhombicMetric,
/// CellLayout and rounded() do it, so the same on every instruction set. Bins are within -2^30 and 2^30.
/// Returns false, and nothing of use, if a point lies more than a box away.
using BinPoints = bool (*)(const BrickBins& bins, const double* positions, std::int32_t count,
                           std::int32_t* bin, std::int16_t* rounded);

BinPoints bin_points(InstructionSet set);

bool bin_points_portable(const BrickBins&, const double*, std::int32_t, std::int32_t*, std::int16_t*);
#ifdef DCH_X86_KERNELS
bool bin_points_avx2(const BrickBins&, const double*, std::int32_t, std::int32_t*, std::int16_t*);
bool bin_points_avx512(const BrickBins&, const double*, std::int32_t, std::int32_t*, std::int16_t*);
#endif

}  // namespace dch::detail
