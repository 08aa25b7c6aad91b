// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace dch::detail {

/// Particles are taken in blocks of so many, in single precision within a pair of blocks.
inline constexpr std::int32_t kPairBlock = 128;

/// All pairs of the particles of a block with themselves and with those after them. Arrays are by particle,
/// aligned, and filled up to whole blocks.
struct AllPairsTask {
  const float* high[3];  ///< coordinates, rounded
  const float* low[3];   ///< what rounding took
  const float* half_sigma;
  const float* root_epsilon;  ///< 2 sqrt(epsilon)
  const float* charge;        ///< times the root of the constant
  std::int32_t count, first;  ///< of all particles; the block's first one
  /// Of each particle of the block: the partners after it that it does not act on, ascending. Moved on.
  const std::int32_t** excluded;
  const std::int32_t* const* excluded_end;
  float* force[3];   ///< on particles from the first one on, by those before them; written
  double (*own)[3];  ///< on the block's particles, by those after them; added to
};

struct AllPairsKernels {
  void (*add[2])(const AllPairsTask& task, double& energy);  ///< without the energy, and with it
};

}  // namespace dch::detail
