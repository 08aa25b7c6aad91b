// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/instruction_set.hpp>
#include <dch/clusters/cluster_pairs.hpp>

namespace dch::detail {

// Coordinates are 16-bit integers relative to the origin of a leaf, as those of ListKernels, but sums and
// differences saturate. Squares are rounded as there; a difference of -32768 counts as 32768, and sums of
// squares as large as that exceed all limits.

/// A cluster beside those of a row: where its slots are, and what its entry will be. The entry's mask has the
/// pairs of its slots that are no padding with any slots.
struct alignas(32) NearCluster {
  std::int16_t x[4], y[4], z[4];
  ClusterPairs::Entry entry;
};

/// A box: lower corner, then the upper one.
struct ClusterBox {
  std::int16_t side[6];
};

/// Clusters side by side, and their boxes, one array for each coordinate of the corners. Arrays of boxes are
/// read, and written, up to kBoxesAtOnce entries beyond.
struct NearClusters {
  const NearCluster* cluster;
  const std::int16_t* side[6];
};
struct NearClustersTo {
  NearCluster* cluster;
  std::int16_t* side[6];
};
inline constexpr int kBoxesAtOnce = 32;

/// What takes clusters to another frame: to be added, saturating, one part after the other, to the 16 numbers
/// of NearCluster. The last one is the number of the shift and stands in the first part alone; the three
/// before it are 0.
struct alignas(32) ClusterMove {
  std::int16_t part[2][16];
};

/// The cluster of a row, relative to the origin that those beside it are relative to.
struct RowCluster {
  const NearCluster& cluster;
  ClusterBox box;
};

struct FoundRow {
  std::int32_t entries = 0;
  std::int32_t compared = 0;  ///< clusters with a box near that of the row's
};

/// Entries of a row are overwritten up to this many beyond.
inline constexpr int kEntriesAtOnce = 8;

/// New positions for clusters.
struct RefreshTask {
  std::int32_t first, last;       ///< of the clusters, up to the last one's next
  const std::int32_t* particle;   ///< by slot; negative for padding, which stands where the first one does
  const std::int32_t* origin_of;  ///< by cluster
  const Vec3* origin;
  const Vec3* origin_in_units;  ///< those of ClusterPairs
  const Vec3* positions;        ///< by particle
  double safe2;                 ///< squared distance that a particle moves less than in one image
  double farthest2;             ///< squared distance that a particle is less than from its origin
  double per_unit;              ///< 1 / ClusterPairs::unit
  ClusterOfFour<double>* at;    ///< by cluster, where they were; written
  ClusterUnits* at_in_units;    ///< by cluster; written
};

/// The same for clusters that are near their places.
struct FollowTask {
  RefreshTask refresh;                 ///< in which safe2 is of the distance from those places
  const ClusterOfFour<double>* place;  ///< by cluster
  const std::int32_t* shift_of;        ///< by cluster; -1 for none
  const ClusterOfFour<double>* shift;  ///< added to positions
  double within2;                      ///< squared distance from its place with which a particle is near
};
struct FollowedClusters {
  std::int32_t away = 0;       ///< of which a particle is not near
  std::int32_t uncertain = 0;  ///< of them those that are left as they were
};

inline constexpr int kJoinedAtOnce = 32;
struct JoinedEntries {
  std::int32_t alone = 0, joined = 0;
};
/// Where they go; up to 2 beyond are overwritten.
struct JoinedEntriesTo {
  ClusterPairs::Entry *alone, *joined;
};

/// How many entries have bits in both halves of their masks, in the lower one alone, and in the upper one
/// alone or nowhere.
struct EntryHalves {
  std::int32_t both = 0, lower = 0, upper = 0;
};
/// Where they go; up to kEntriesAtOnce beyond are overwritten.
struct EntryHalvesTo {
  ClusterPairs::Entry *both, *lower, *upper;
};

/// The loops of the search of cluster pairs, compiled for one instruction set. No function allocates. All
/// sets do the same.
struct ClusterSearchKernels {
  /// Copies, in order, those of `count` clusters with a box near another one, as in the frame that `move`
  /// leads to: sum of square(gap) < limit, with the gap along each axis, the box being in the frame that they
  /// come from. Returns how many.
  std::int32_t (*keep_near)(const NearClusters& from, std::int32_t count, const ClusterBox& box,
                            std::int16_t limit, const ClusterMove& move, const NearClustersTo& to);

  /// Writes the entries of a row, with the pairs of slots that are near, that is with a sum of
  /// square(difference) < limit: those of `count` clusters that have any.
  FoundRow (*find_row)(const RowCluster& row, const NearClusters& from, std::int32_t count,
                       std::int16_t limit, ClusterPairs::Entry* to);

  /// Takes positions, but for the clusters of which one particle seems to have moved farther, or to be
  /// farther from its origin, or nowhere finite: those it leaves as they were, and writes their numbers,
  /// ascending; there has to be room for all. Returns how many.
  std::int32_t (*refresh)(const RefreshTask& task, std::int32_t* far);

  /// Takes positions, but for the clusters of which one particle is farther than safe2 from its place, or
  /// nowhere finite, and writes the numbers of clusters of which one is not near, those included, ascending;
  /// there has to be room for all.
  FollowedClusters (*follow)(const FollowTask& task, std::int32_t* away);

  /// Copies up to kJoinedAtOnce entries: two by two those with no bit of their masks in common, and those
  /// that stay alone. Fuller ones are asked first, and get the fullest one that fits. What is alone may go to
  /// where the entries are.
  JoinedEntries (*join)(const ClusterPairs::Entry* entries, std::int32_t count, const JoinedEntriesTo& to);

  /// Copies entries, in order, by the halves of their masks that have bits.
  EntryHalves (*split)(const ClusterPairs::Entry* entries, std::int32_t count, const EntryHalvesTo& to);
};

/// The kernels of a set that is supported.
const ClusterSearchKernels& cluster_search_kernels(InstructionSet set);

}  // namespace dch::detail
