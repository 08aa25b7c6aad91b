// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/geometry/box.hpp>
#include <dch/lists/list_maker.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "base/aligned_vector.hpp"
#include "leaves/leaf_source.hpp"
#include "lists/list_limits.hpp"
#include "lists/near_ranges.hpp"
#include "lists/pair_filter.hpp"

namespace dch::detail {

/// Finds the rows of one leaf after the other: its points with each other, with those of the leaves
/// that an edge of level 1 joins to it, and with those of other hierarchies. Holds what that takes, so each
/// thread has one of its own.
class RowFinder {
 public:
  struct Request {
    const PairFilter* filter;
    ListLimits limits;
  };
  /// What the rows are found in, the same for all leaves.
  template <class Metric>
  struct Scene {
    const Metric& metric;
    const Box& box;
    std::vector<NearSource> near;   ///< the hierarchy of the rows first
    std::vector<Request> requests;  ///< one a list, the one with the largest radius first

    const LeafSource& rows() const { return *near.front().source; }
  };

  /// For all rows so far.
  const ListWork& work() const { return work_; }

  /// To be called before the first rows of a list.
  void use(InstructionSet set) { kernels_ = &list_kernels(set); }

  /// Appends the rows of leaf k to a list for each request.
  template <class Metric>
  void append_rows(const Scene<Metric>& scene, std::int32_t k, NeighborList* lists);
  std::size_t memory_bytes() const;

 private:
  using Leaf = MeasuredLeaves::Leaf;
  using PairLimits = ListLimits::PairLimits;
  struct CandidateStore {
    AlignedVector<std::int16_t> x, y, z, tag;
    AlignedVector<std::int32_t> id;  ///< grows last: the others have room for as many at least
    Candidates at(std::int32_t k);
    void make_room(std::size_t count);
    std::size_t memory_bytes() const;
  };

  /// A block of the leaf and the candidates near it.
  struct BlockTest {
    CandidateStore near;
    std::int32_t count = 0, chunks = 0;
    std::int32_t left = 0;              ///< entries of unsettled_
    AlignedVector<std::uint32_t> mask;  ///< row by chunk
    AlignedVector<std::uint32_t>
        near_mask;  ///< the same, of those that come first in their row, where asked for
  };
  /// A pair that the kernels could not decide.
  struct OpenPair {
    std::int32_t i, j;
    std::uint32_t* mask;
    std::uint32_t bit;
  };
  /// Blocks of a leaf that are looked at together.
  struct Part {
    std::int32_t first, last;
    bool owned;         ///< whether a point of the leaf is not a ghost
    std::int16_t size;  ///< the largest of the points, where cutoffs go by radii
    BlockSpan span;
  };

  static Part part_of(const LeafSource& leaves, std::int32_t k, std::int32_t first, std::int32_t last);
  template <class Metric>
  void find_ranges(const Scene<Metric>& scene, std::int32_t k);
  template <class Metric>
  std::int32_t collect(const Scene<Metric>& scene, const Part& part);
  std::int32_t collect_from(const NearSource& near, const std::vector<BlockRange>& ranges,
                            const BlockSpan& box, bool owned, std::int32_t already);
  std::int32_t leave_out_ghosts(const LeafSource& leaves, std::int32_t range_count);
  std::int32_t filter(const ListLimits& limits, const BlockSpan& span, std::int16_t size,
                      const Candidates& from, const std::uint32_t* valid, std::int32_t count,
                      const Candidates& to) const;
  template <class Metric>
  void append_part(const Scene<Metric>& scene, const Request& request, const Part& part,
                   const Candidates& around_part, std::int32_t count, NeighborList& out);
  void make_room_for_tests(std::int32_t count);
  void test_block(const Request& request, const LeafSource& leaves, std::int32_t block, BlockTest& test);
  std::int32_t test_against(const ListLimits& limits, const PairLimits& pairs, const LeafSource& leaves,
                            std::int32_t block, BlockTest& test, std::uint32_t* mask);
  static double cutoff_of(const ListLimits& limits, const LeafSource& leaves, std::int32_t block,
                          std::int32_t row, std::int16_t tag);
  static double squared_distance(const BlockPoints& points, std::int32_t row, const CandidateStore& near,
                                 std::int32_t at);
  void note_open_pairs(const Request& request, const LeafSource& leaves, std::int32_t block, BlockTest& test);
  void settle(const PairFilter& filter);
  static void ask_for_exclusions(const PairFilter& filter, const LeafSource& leaves, std::int32_t first,
                                 std::int32_t last);
  void append_block(const Request& request, const LeafSource& leaves, std::int32_t block, bool meets_itself,
                    BlockTest& test, NeighborList& out);
  std::size_t append_some(const Request& request, std::int32_t particle, const std::uint32_t* mask,
                          const BlockTest& test, std::int32_t* to) const;
  std::int32_t restrict_row(const Request& request, std::int32_t particle, std::int32_t* row,
                            std::int32_t count) const;

  const ListKernels* kernels_ = nullptr;
  ListWork work_;
  std::vector<std::vector<BlockRange>> ranges_;  ///< by source: blocks of leaves near the leaf
  std::vector<std::int32_t> block_, range_end_;
  std::size_t block_room_ = 0;  ///< blocks that block_ and valid_ have room for
  CandidateStore around_part_, around_request_, around_group_;
  std::vector<Unsettled> unsettled_;
  std::vector<std::uint32_t> valid_;
  std::vector<BlockTest> tests_;  ///< of the blocks that are looked at together
  std::size_t test_room_ = 0;     ///< masks that each of them and unsettled_ have room for
  std::vector<OpenPair> open_;    ///< and room for more
  std::size_t open_count_ = 0;
};

}  // namespace dch::detail
