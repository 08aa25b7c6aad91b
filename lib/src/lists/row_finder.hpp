// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/instruction_set.hpp>
#include <dch/base/span.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "base/resize.hpp"
#include "leaves/own_blocks.hpp"
#include "lists/candidate_store.hpp"
#include "lists/open_pairs.hpp"
#include "lists/row_request.hpp"

namespace dch::detail {

/// Finds the rows of some blocks of points among the candidates near them, whoever has gathered these. Holds
/// what that takes, so each thread has one of its own.
class RowFinder {
 public:
  /// To be called before the first rows of a list.
  void use(InstructionSet set) { kernels_ = &list_kernels(set); }

  /// Says that `done` of `all` places have their rows, about as many each: lists that have no more room get
  /// memory by what they will hold.
  void note_progress(std::int32_t done, std::int32_t all) { progress_ = {done, all}; }

  /// Appends the rows of the blocks to a list for each request, of which the first has the largest radius.
  /// @param around what may be within reach of the blocks, with room for kChunk more
  void append_rows(const std::vector<RowRequest>& requests, const OwnBlocks& own, const Candidates& around,
                   std::int32_t count, NeighborList* lists);

  /// Pairs of a block's lanes and points near the block, of all rows so far.
  std::int64_t tested() const { return tested_; }
  std::size_t memory_bytes() const;

 private:
  /// The candidates near a block.
  struct BlockNear {
    CandidateStore candidates;
    std::int32_t count = 0;
  };

  void append_list(const RowRequest& request, const OwnBlocks& own, const Candidates& around,
                   std::int32_t count, NeighborList& out);
  void append_group(const RowRequest& request, const OwnBlocks& own, std::int32_t first, std::int32_t last,
                    const Candidates& around, std::int32_t count, NeighborList& out);
  void make_room(std::int32_t count);
  void write_group(const RowRequest& request, const OwnBlocks& own, std::int32_t first, std::int32_t last,
                   std::int32_t* to);
  static void ask_for_exclusions(const PairFilter& filter, const OwnBlocks& own, std::int32_t first,
                                 std::int32_t last);
  bool note_exclusions(const PairFilter& filter, const OwnBlocks& own, std::int32_t first, std::int32_t last);
  void finish_rows(const RowRequest& request, const OwnBlocks& own, std::int32_t block,
                   const std::vector<RowEdit>& edits, NeighborList& out);
  std::int32_t finish_segment(const RowRequest& request, std::int32_t particle, const std::int32_t* from,
                              std::int32_t length, Span<const RowEdit> edits, std::int32_t* to) const;
  std::int32_t restricted_row(const RowRequest& request, std::int32_t particle, const std::int32_t* row,
                              std::int32_t count, std::int32_t* to) const;
  void append_ends(const RowRequest& request, const OwnBlocks& own, std::int32_t first, std::int32_t last,
                   NeighborList& out) const;

  const ListKernels* kernels_ = nullptr;
  std::int64_t tested_ = 0;
  Progress progress_;
  CandidateStore around_request_, around_group_;
  std::vector<BlockNear> near_;        ///< of the blocks that are looked at together
  std::vector<OpenLanes> open_lanes_;  ///< of one of them
  std::size_t room_ = 0;               ///< entries of open_lanes_; near_ has room for as many candidates
  /// Of the blocks that are looked at together, where each segment ends, after a 0.
  std::vector<std::int32_t> segment_end_;
  std::int32_t segments_ = 0;
  std::vector<std::int32_t> excluded_;    ///< of their rows, as RowsTo has it; empty if there are none
  std::vector<std::int32_t> as_written_;  ///< their rows, where exclusions and ghosts have to be left out
  OpenPairs open_;
};

}  // namespace dch::detail
