// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/instruction_set.hpp>

#include "simd/list_kernels.hpp"

namespace dch::detail {

/// Blocks of points near a leaf, in its frame: boxes in one array for each of their sides, and coordinates,
/// kBlock an axis, block after block, infinite in lanes without a point. Each array of boxes can be read up
/// to kChunk entries beyond its end.
struct NearBlocks {
  const float *low[3], *high[3];
  const float* coordinates;
};

/// A box and how far others may be from it.
struct BoxAndReach {
  float low[3], high[3];
  float reach2;
};

/// The points of some blocks side by side: their coordinates, and their slots, kBlock a block. There is room
/// for kChunk more than their blocks have lanes.
struct NearPoints {
  float* at[3];
  std::int32_t* slot;
};

/// Whose neighbors are looked for, and how far.
struct NearestTask {
  float at[3];
  std::int32_t own_slot;  ///< of the point itself, which is no neighbor
  float reach2;           ///< finite
};

/// What was found. Up to kChunk entries beyond `room` are overwritten.
struct NearestFound {
  float* distance2;
  std::int32_t* slot;
  std::int32_t count, room;
};

struct NearestKernels {
  /// Finds the blocks with boxes within reach of a box, and their squared gaps. Returns how many; room for
  /// kChunk more is needed.
  std::int32_t (*select)(const BoxAndReach& box, const NearBlocks& blocks, std::int32_t count,
                         std::int32_t* block, float* gap2);

  /// Puts the points of some blocks side by side, and after them as many infinitely far away as make the
  /// number a multiple of kChunk. Returns that number.
  std::int32_t (*gather)(const std::int32_t* block, std::int32_t count, const NearBlocks& blocks,
                         const NearPoints& to);

  /// Appends those of the points from `first` to before `last`, both multiples of kChunk, that are within
  /// reach, in order. Returns where it stopped: before `last` if there may be no room for what is found next.
  std::int32_t (*search)(const NearestTask& task, const NearPoints& points, std::int32_t first,
                         std::int32_t last, NearestFound& found);

  /// Says of each of some keys how many are smaller. Arrays are read and overwritten up to kChunk entries
  /// beyond `count`.
  void (*rank)(const std::int32_t* key, std::int32_t count, std::int32_t* rank);
};

/// The kernels of a set that is supported.
const NearestKernels& nearest_kernels(InstructionSet set);

extern const NearestKernels kNearestPortable;
#ifdef DCH_X86_KERNELS
extern const NearestKernels kNearestAvx2, kNearestAvx512;
#endif

}  // namespace dch::detail
