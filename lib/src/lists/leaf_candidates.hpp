// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/instruction_set.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/list_maker.hpp>

#include "leaves/leaf_source.hpp"
#include "leaves/own_blocks.hpp"
#include "lists/candidate_store.hpp"
#include "lists/near_ranges.hpp"
#include "lists/row_request.hpp"

namespace dch::detail {

/// What rows are found in, the same for all leaves.
template <class Metric>
struct LeafScene {
  const Metric& metric;
  const Box& box;
  std::vector<NearSource> near;      ///< the hierarchy of the rows first
  std::vector<RowRequest> requests;  ///< one a list, the one with the largest radius first

  const LeafSource& rows() const { return *near.front().source; }
};

/// Gathers the points near one leaf after the other: its own, those of the leaves that an edge of level 1
/// joins to it, and those of other hierarchies.
class LeafCandidates {
 public:
  /// To be called before the first leaf of a list.
  void use(InstructionSet set) { kernels_ = &list_kernels(set); }

  /// Calls f(own, candidates, count) for parts of leaf k: the candidates that may be within reach of the
  /// first request are the part's own points, in order, then those of the leaf's parts after it, then others.
  template <class Metric, class F>
  void for_each_part(const LeafScene<Metric>& scene, std::int32_t k, const F& f) {
    const LeafSource& leaves = scene.rows();
    const MeasuredLeaves::Leaf& leaf = leaves.measured().leaves[k];
    find_ranges(scene, k);
    for_each_group(leaf.first_block, leaf.blocks, kPart, [&](std::int32_t first, std::int32_t last) {
      OwnBlocks own = leaves.blocks(first, last);
      own.are_candidates = leaves.labelled.leaf_owned[k] != 0;
      const std::int32_t count = collect(scene, {first, last, own});
      f(own, around_.at(0), count);
    });
  }

  /// For all leaves so far.
  const ListWork& work() const { return work_; }
  std::size_t memory_bytes() const;

 private:
  static constexpr std::int32_t kPart = 24;  ///< most blocks in one
  /// Blocks of a leaf that are looked at together.
  struct Part {
    std::int32_t first, last;
    const OwnBlocks& own;
  };
  template <class Metric>
  void find_ranges(const LeafScene<Metric>& scene, std::int32_t k);
  template <class Metric>
  std::int32_t collect(const LeafScene<Metric>& scene, const Part& part);
  std::int32_t collect_from(const NearSource& near, const std::vector<BlockRange>& ranges,
                            const BlockSpan& box, bool owned, std::int32_t already);
  std::int32_t leave_out_ghosts(const LeafSource& leaves, std::int32_t range_count);

  const ListKernels* kernels_ = nullptr;
  ListWork work_;
  std::vector<std::vector<BlockRange>> ranges_;  ///< by source: blocks of leaves near the leaf
  std::vector<std::int32_t> block_, range_end_;
  std::size_t block_room_ = 0;  ///< blocks that block_ and valid_ have room for
  std::vector<std::uint32_t> valid_;
  CandidateStore around_;
};

}  // namespace dch::detail
