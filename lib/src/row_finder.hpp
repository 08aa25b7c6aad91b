// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/box.hpp>
#include <dch/neighbor_list.hpp>

#include "cluster_points.hpp"
#include "list_limits.hpp"
#include "list_source.hpp"
#include "near_ranges.hpp"
#include "pair_filter.hpp"

namespace dch::detail {

/// Finds the rows of one cluster after the other: its points with each other, with those of the clusters
/// that an edge of level 1 joins to it, and with those of other hierarchies. Holds what that takes, so each
/// thread has one of its own.
class RowFinder {
 public:
  struct Request {
    const PairFilter* filter;
    ListLimits limits;
  };
  /// What the rows are found in, the same for all clusters.
  template <class Metric>
  struct Scene {
    const Metric& metric;
    const Box& box;
    std::vector<NearSource> near;   ///< the hierarchy of the rows first
    std::vector<Request> requests;  ///< one a list, the one with the largest radius first

    const ListSource& rows() const { return *near.front().source; }
  };

  /// To be called before the first rows of a list.
  void use(InstructionSet set) { kernels_ = &list_kernels(set); }

  /// Appends the rows of cluster k to a list for each request.
  template <class Metric>
  void append_rows(const Scene<Metric>& scene, std::int32_t k, NeighborList* lists);
  std::size_t memory_bytes() const;

 private:
  using Cluster = ClusterPoints::Cluster;
  struct CandidateStore {
    std::vector<std::int16_t> x, y, z, tag;
    std::vector<std::int32_t> id;
    Candidates at(std::int32_t k);
    void make_room(std::size_t count);
    std::size_t memory_bytes() const;
  };

  /// A block of the cluster and the candidates near it.
  struct BlockTest {
    std::vector<std::int32_t> ids;
    std::int32_t chunks = 0;
    std::int32_t left = 0;            ///< entries of unsettled_
    std::vector<std::uint32_t> mask;  ///< row by chunk
  };
  /// A pair that the kernels could not decide.
  struct OpenPair {
    std::int32_t i, j;
    std::int32_t slot_i, slot_j;  ///< kNone where there are several hierarchies
    std::uint32_t* mask;
    std::uint32_t bit;
  };
  static constexpr std::int32_t kGroup = 4;  ///< blocks that are looked at together

  template <class Metric>
  std::int32_t collect(const Scene<Metric>& scene, std::int32_t k);
  std::int32_t collect_from(const NearSource& near, const Cluster& cluster, std::int32_t already);
  std::int32_t filter(const ListLimits& limits, const BlockSpan& span, std::int16_t size,
                      const Candidates& from, const std::uint32_t* valid, std::int32_t count,
                      const Candidates& to) const;
  template <class Metric>
  void append_cluster(const Scene<Metric>& scene, const Request& request, const Cluster& cluster,
                      const Candidates& around_cluster, std::int32_t count, NeighborList& out);
  void make_room_for_tests(std::int32_t count);
  template <class Metric>
  void test_block(const Scene<Metric>& scene, const Request& request, std::int32_t block, std::int32_t begin,
                  std::int32_t end, BlockTest& test);
  template <class Metric>
  void note_open_pairs(const Scene<Metric>& scene, const Request& request, std::int32_t block,
                       bool meets_itself, BlockTest& test);
  template <class Metric>
  void settle(const Scene<Metric>& scene, const Request& request);
  static void ask_for_exclusions(const PairFilter& filter, const ClusterPoints& points, std::int32_t first,
                                 std::int32_t last);
  void append_block(const Request& request, const ClusterPoints& points, std::int32_t block,
                    bool meets_itself, BlockTest& test, NeighborList& out);
  static std::int32_t restrict_row(const Request& request, std::int32_t particle, std::int32_t* row,
                                   std::int32_t count);

  const ListKernels* kernels_ = nullptr;
  std::vector<BlockRange> ranges_;
  std::vector<std::int32_t> block_, range_;
  CandidateStore around_cluster_, around_request_, around_group_;
  CandidateStore around_block_;  ///< but for the ids, which outlive the test of a block
  std::vector<Unsettled> unsettled_;
  std::vector<std::uint32_t> valid_;
  BlockTest tests_[kGroup];
  std::vector<OpenPair> open_;
};

}  // namespace dch::detail
