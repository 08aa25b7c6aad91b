// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/cluster_pairs.hpp>
#include <dch/fene.hpp>
#include <dch/instruction_set.hpp>

#include "lj_task.hpp"

namespace dch::detail {

/// Boxes side by side: lower corners x, y, z, then upper ones.
struct BoxArrays {
  const float* side[6];
};

/// Arrays of boxes are read up to this many entries beyond.
inline constexpr int kBoxesAtOnce = 16;

/// New positions for clusters.
struct RefreshTask {
  std::int32_t first, last;       ///< of the clusters, up to the last one's next
  const std::int32_t* particle;   ///< by slot; negative for padding, which stands where the first one does
  const std::int32_t* origin_of;  ///< by cluster
  const Vec3* origin;
  const Vec3* positions;           ///< by particle
  double safe2;                    ///< squared distance that a particle moves less than in one image
  double grid;                     ///< BinaryGrid::addend()
  ClusterOfFour<double>* at;       ///< by cluster, where they were; written
  ClusterOfFour<float>* at_float;  ///< by cluster; written
};

/// Bonds, and coefficients by type: k, 1/r0^2, sigma^2, 48 epsilon.
struct FeneTask {
  const BondOfType* bonds;
  std::int64_t count;
  std::int32_t first_type, types;
  const double* table[4];
  const Vec3* positions;
  Vec3* forces;    ///< added to
  double* virial;  ///< six sums of d f, added to; null if not wanted
};

/// The loops over clusters of four, and those of forces, compiled for one instruction set. No function
/// allocates.
struct ClusterKernels {
  /// Finds those of `count` boxes with a squared distance to a box of at most limit2. Writes their numbers,
  /// ascending, and returns how many; room for `count` rounded up to kBoxesAtOnce is needed. All sets find
  /// the same.
  std::int32_t (*near_boxes)(const BoxArrays& boxes, std::int32_t count, const float* box, float limit2,
                             std::int32_t* chosen);

  /// Keeps those of `count` chosen clusters with a slot whose squared distance to a slot of `own` is at most
  /// limit2. Returns how many. All sets keep the same.
  std::int32_t (*near_clusters)(const ClusterOfFour<float>* clusters, const ClusterOfFour<float>& own,
                                float limit2, std::int32_t* chosen, std::int32_t count);

  /// Takes positions, but for the clusters of which one particle seems to have moved farther, or nowhere
  /// finite: those it leaves as they were, and writes their numbers, ascending; there has to be room for all.
  /// Returns how many. All sets do the same.
  std::int32_t (*refresh)(const RefreshTask& task, std::int32_t* far);

  LjFunctions<LjTask<float>> mixed;
  LjFunctions<LjTask<double>> full;
  LjFunctions<LjPairTask> pairs;

  /// Adds forces of all bonds but those that are too long, whose numbers it writes, ascending; there has to
  /// be room for all. Returns how many.
  std::int32_t (*fene)(const FeneTask& task, std::int32_t* too_long);
};

/// The kernels of a set that is supported.
const ClusterKernels& cluster_kernels(InstructionSet set);

}  // namespace dch::detail
