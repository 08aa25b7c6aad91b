// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/box.hpp>
#include <dch/neighbor_list.hpp>

#include "cluster_points.hpp"
#include "hierarchy_level.hpp"
#include "pair_filter.hpp"
#include "point_blocks.hpp"

namespace dch::detail {

/// Finds the rows of one cluster after the other: its points with each other and with those of the clusters
/// that an edge of level 1 joins to it. Holds what that takes, so each thread has one of its own.
class RowFinder {
 public:
  /// What the rows are found in, the same for all clusters.
  template <class Metric>
  struct Scene {
    const Metric& metric;
    const Box& box;
    const Level& centers;
    const PointBlocks& blocks;
    Span<const std::int32_t> slot_of_id;
    const ClusterPoints& points;
    const PairFilter& filter;
    double reach;    ///< square root of filter.largest_distance2()
    bool one_image;  ///< whether only the nearest image of a cluster can matter to another one

    /// Squared distance of the nearest wrapped images of two particles.
    double wrapped_distance2(std::int32_t i, std::int32_t j) const {
      return metric.distance2(blocks.position[slot_of_id[i]], blocks.position[slot_of_id[j]]);
    }
  };

  /// To be called before the first rows of a list.
  void use(InstructionSet set) { kernels_ = &list_kernels(set); }

  /// Appends the rows of cluster k.
  template <class Metric>
  void append_rows(const Scene<Metric>& scene, std::int32_t k, NeighborList& out);
  std::size_t memory_bytes() const;

 private:
  using Cluster = ClusterPoints::Cluster;
  struct CandidateStore {
    std::vector<std::int16_t> x, y, z;
    std::vector<std::int32_t> id;
    Candidates at(std::int32_t k);
    void make_room(std::size_t count);
  };

  template <class Metric>
  void add_ranges(const Scene<Metric>& scene, std::int32_t k);
  void add_range(const ClusterPoints& points, const Cluster& other, Vec3 between);
  void make_room();
  std::int32_t collect(const ClusterPoints& points, const Cluster& cluster);
  template <class Metric>
  void append_block(const Scene<Metric>& scene, std::int32_t block, bool meets_itself, std::int32_t begin,
                    std::int32_t end, NeighborList& out);
  static std::int32_t restrict_row(std::int32_t particle, std::int32_t* row, std::int32_t count,
                                   const PairFilter& filter);

  const ListKernels* kernels_ = nullptr;
  std::vector<BlockRange> ranges_;
  std::vector<std::int32_t> block_, range_;
  CandidateStore around_cluster_, around_group_, around_block_;
  std::vector<std::uint32_t> valid_, mask_;
  std::vector<Unsettled> unsettled_;
};

}  // namespace dch::detail
