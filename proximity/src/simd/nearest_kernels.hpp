// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/instruction_set.hpp>

#include "simd/list_kernels.hpp"

namespace dch::detail {

/// Blocks of points near a leaf, in its frame: boxes in one array for each of their sides, and coordinates,
/// kBlock an axis, block after block. Each array of boxes can be read up to kChunk entries beyond its end.
struct NearBlocks {
  const float *low[3], *high[3];
  const float* coordinates;
  const std::uint8_t* count;  ///< points in a block
};

/// A box and how far others may be from it.
struct BoxAndReach {
  float low[3], high[3];
  float reach2;
};

/// One point, and the blocks to look for its neighbors in.
struct NearestTask {
  float at[3];
  std::int32_t own_slot;      ///< of the point itself, which is no neighbor; kBlock a block
  const std::int32_t* block;  ///< in ascending order of their gaps
  const float* gap2;          ///< squared distance of each from a box that the point is in
  std::int32_t blocks;
  std::int32_t k;
  std::int32_t room;  ///< for candidates, more than k
  float reach2;       ///< no farther ones
  /// Squared distances that may be equal differ by less than kBlur times the larger one, plus this.
  float blur;
};

inline constexpr float kBlur = 1e-3f;

/// Candidates for the k nearest, ascending: all that may be among them, given the blur.
struct NearestFound {
  float* distance2;
  std::int32_t* slot;
  std::int32_t count;
  bool is_full;  ///< there was no room for all; what was found is of no use then
  std::int32_t blocks_seen, points_seen;
};

struct NearestKernels {
  /// Finds the blocks with boxes within reach of a box, and their squared gaps. Returns how many; room for
  /// kChunk more is needed.
  std::int32_t (*select)(const BoxAndReach& box, const NearBlocks& blocks, std::int32_t count,
                         std::int32_t* block, float* gap2);
  void (*search)(const NearestTask& task, const NearBlocks& blocks, NearestFound& found);
};

/// The kernels of a set that is supported.
const NearestKernels& nearest_kernels(InstructionSet set);

extern const NearestKernels kNearestPortable;
#ifdef DCH_X86_KERNELS
extern const NearestKernels kNearestAvx2, kNearestAvx512;
#endif

}  // namespace dch::detail
