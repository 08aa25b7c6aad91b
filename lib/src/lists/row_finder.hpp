// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/instruction_set.hpp>
#include <dch/lists/neighbor_list.hpp>

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

  /// Appends the rows of the blocks to a list for each request, of which the first has the largest radius.
  /// @param around what may be within reach of the blocks, with room for kChunk more
  void append_rows(const std::vector<RowRequest>& requests, const OwnBlocks& own, const Candidates& around,
                   std::int32_t count, NeighborList* lists);

  /// Pairs of a block's lanes and points near the block, of all rows so far.
  std::int64_t tested() const { return tested_; }
  std::size_t memory_bytes() const;

 private:
  using PairLimits = ListLimits::PairLimits;

  void append_list(const RowRequest& request, const OwnBlocks& own, const Candidates& around,
                   std::int32_t count, NeighborList& out);
  void append_group(const RowRequest& request, const OwnBlocks& own, std::int32_t first, std::int32_t last,
                    const Candidates& around, std::int32_t count, NeighborList& out);
  void make_room_for_tests(std::int32_t count);
  void test_block(const RowRequest& request, const OwnBlocks& own, std::int32_t block, BlockTest& test);
  std::int32_t test_against(const ListLimits& limits, const PairLimits& pairs, const OwnBlocks& own,
                            std::int32_t block, BlockTest& test, std::uint32_t* mask);
  static void ask_for_exclusions(const PairFilter& filter, const OwnBlocks& own, std::int32_t first,
                                 std::int32_t last);
  void append_block(const RowRequest& request, const OwnBlocks& own, std::int32_t block, BlockTest& test,
                    NeighborList& out);
  std::size_t append_some(const RowRequest& request, std::int32_t particle, const std::uint32_t* mask,
                          BlockTest& test, std::int32_t* to) const;
  std::int32_t restrict_row(const RowRequest& request, std::int32_t particle, std::int32_t* row,
                            std::int32_t count) const;

  const ListKernels* kernels_ = nullptr;
  std::int64_t tested_ = 0;
  CandidateStore around_request_, around_group_;
  std::vector<Unsettled> unsettled_;
  std::vector<BlockTest> tests_;  ///< of the blocks that are looked at together
  std::size_t test_room_ = 0;     ///< masks that each of them and unsettled_ have room for
  OpenPairs open_;
};

}  // namespace dch::detail
