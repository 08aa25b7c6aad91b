// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>

#include "leaves/own_blocks.hpp"
#include "lists/row_request.hpp"

namespace dch::detail {

/// An entry that a row has and is to lose, or that it lacks and is to get.
struct RowEdit {
  std::int32_t segment;  ///< see OpenLanes
  std::int32_t place;    ///< in the segment as it was written
  std::int32_t id;
  bool is_missing;
};

/// Edits rows where they stand, segment after segment.
/// @param edits in the order of their places
/// @param ends where each segment ends, after a 0; is brought up to date
void apply_edits(Span<const RowEdit> edits, std::int32_t* ids, Span<std::int32_t> ends);

/// Pairs that the kernels could not decide: by unrounded squares of the integers first, then by positions.
class OpenPairs {
 public:
  void clear() { count_ = 0; }
  /// Decides what the rows of a block have left open, or notes it if that takes the positions.
  /// @param before segments of the blocks before
  void note(const RowRequest& request, const OwnBlocks& own, std::int32_t block, std::int32_t before,
            const Candidates& near, const OpenLanes* open, std::int32_t open_count);
  /// Decides what has been noted since clear(). Returns what rows as written have wrong, in their order.
  const std::vector<RowEdit>& decide(const PairFilter& filter);
  std::size_t memory_bytes() const {
    return open_.capacity() * sizeof(OpenPair) + edits_.capacity() * sizeof(RowEdit);
  }

 private:
  struct OpenPair {
    RowEdit edit;  ///< that is needed if it comes out otherwise than written
    std::int32_t i;
    bool is_decided;
  };
  std::vector<OpenPair> open_;  ///< and room for more
  std::size_t count_ = 0;
  std::vector<RowEdit> edits_;
};

}  // namespace dch::detail
