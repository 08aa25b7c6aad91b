// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/box.hpp>
#include <dch/neighbor_list.hpp>
#include <dch/vec3.hpp>

#include "hierarchy_level.hpp"
#include "pair_filter.hpp"
#include "point_blocks.hpp"
#include "simd/list_kernels.hpp"

namespace dch::detail {

/// Writes neighbor lists from clusters of points that the conflict graph joins: the level-0 edges, enumerated
/// among the children of equal or neighboring level-1 nodes (Lemma 5.3.1(5)).
///
/// Points are held relative to the center of their cluster, as 16-bit integers: a test of 32 pairs is a few
/// instructions, and its precision does not depend on the box. What such a test leaves open, a band of about
/// a thousandth of the cutoff, is decided by the pair distance in double. The integer arithmetic is the same
/// on every instruction set, so the rows are too.
class ClusterRows {
 public:
  /// Takes the positions of the points relative to their cluster's center. To be called again when a point
  /// has moved, come or gone.
  template <class Metric>
  void measure(const Metric& metric, const Level& clusters, const PointBlocks& points);
  /// Distance of the farthest point of a cluster from its center [length].
  double extent(std::int32_t cluster) const { return clusters_[cluster].extent; }

  /// Finds all pairs that the filter accepts, as a half list ordered by structure, ghosts having rows like
  /// all others. Edges must join all clusters with points within `reach`, the square root of
  /// filter.largest_distance2().
  template <class Metric>
  void find(const Metric& metric, const Box& box, const Level& clusters, const PointBlocks& points,
            Span<const std::int32_t> slot_of_id, std::int32_t first_ghost, double error,
            const PairFilter& filter, NeighborList& out);
  std::size_t memory_bytes() const;

 private:
  struct Cluster {
    std::int32_t first_block = 0, blocks = 0;
    double extent = 0;  ///< distance of the farthest point from the center [length]
    BlockBox box{};     ///< of all blocks
    BlockSpan span{};   ///< the same in the units of points
    bool owned = true;  ///< whether a point is not a ghost
  };

  struct Offset {
    float x, y, z;
  };
  struct CandidateStore {
    std::vector<std::int16_t> x, y, z;
    std::vector<std::int32_t> id;
    Candidates at(std::int32_t k);
    void make_room(std::size_t count);
  };

  void quantize(const PointBlocks& points, std::int32_t first_ghost, double reach, double error);
  template <class Metric>
  void add_ranges(const Metric& metric, const Box& box, const Level& clusters, std::int32_t k, double reach);
  void add_range(const Cluster& other, Vec3 between);
  template <class Distance2>
  void find_rows(const Cluster& cluster, const PairFilter& filter, const Distance2& wrapped_distance2,
                 NeighborList& out);
  std::int32_t keep_owned_blocks(std::int32_t collected);
  BlockSpan span_of_blocks(std::int32_t first, std::int32_t last) const;
  template <class Distance2>
  void row_block(std::int32_t block, bool meets_itself, std::int32_t begin, std::int32_t end,
                 const PairFilter& filter, const Distance2& wrapped_distance2, NeighborList& out);
  std::int32_t restrict_row(std::int32_t particle, std::int32_t* row, std::int32_t count,
                            const PairFilter& filter) const;
  template <class Metric>
  void find_by_distance(const Metric& metric, const Level& clusters, const PointBlocks& points,
                        const PairFilter& filter, NeighborList& out);

  const ListKernels* kernels_ = nullptr;
  bool one_image_ = true;  ///< whether only the nearest image of a cluster can matter to another one
  double point_unit_ = 1, box_unit_ = 1;  ///< [length]
  double per_point_unit_ = 1, per_box_unit_ = 1;
  std::int16_t box_limit_ = 0;     ///< see ListKernels::select
  std::int16_t in_ = 0, out_ = 0;  ///< see ListKernels::test
  double largest_extent_ = 0;      ///< of a cluster
  double largest_width_ = 0;       ///< of a cluster along an axis
  double largest_size_ = 0;        ///< of a block along an axis

  std::vector<Cluster> clusters_;
  std::int32_t blocks_ = 0;
  std::vector<std::int32_t> source_;  ///< by block: the block of PointBlocks
  std::vector<Offset> offset_;        ///< by slot: position relative to the cluster's center
  std::vector<Vec3> low_, high_;      ///< by block: corners of the box around its points, likewise
  std::vector<BlockPoints> points_;
  std::vector<BlockBox> boxes_;
  std::vector<BlockSpan> spans_;
  std::vector<std::array<std::int32_t, kBlock>> ids_;
  std::vector<std::uint8_t> counts_;  ///< by block: number of points
  std::vector<std::uint8_t> owned_;   ///< by block: whether a point is not a ghost

  // of the cluster at hand
  std::vector<BlockRange> ranges_;
  std::vector<std::int32_t> block_, range_;
  CandidateStore around_cluster_, around_group_, around_block_;
  std::vector<std::uint32_t> valid_, mask_;
  std::vector<Unsettled> unsettled_;
};

}  // namespace dch::detail
