// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/instruction_set.hpp>
#include <dch/clusters/cluster_pairs.hpp>

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

/// The loops of the search of cluster pairs, compiled for one instruction set. No function allocates.
struct ClusterSearchKernels {
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
};

/// The kernels of a set that is supported.
const ClusterSearchKernels& cluster_search_kernels(InstructionSet set);

}  // namespace dch::detail
