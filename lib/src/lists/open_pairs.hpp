// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/aligned_vector.hpp"
#include "leaves/own_blocks.hpp"
#include "lists/candidate_store.hpp"
#include "lists/row_request.hpp"

namespace dch::detail {

/// A block and the candidates near it.
struct BlockTest {
  CandidateStore near;
  std::int32_t count = 0, chunks = 0;
  std::int32_t left = 0;              ///< entries that the kernels left unsettled
  AlignedVector<std::uint32_t> mask;  ///< row by chunk
  /// The same, of those that come first in their row, where asked for.
  AlignedVector<std::uint32_t> near_mask;
};

/// Pairs that the kernels could not decide: by unrounded squares of the integers first, then by positions.
class OpenPairs {
 public:
  void clear() { count_ = 0; }
  /// Decides what the test of a block has left open, or notes it if that takes the positions.
  void note(const RowRequest& request, const OwnBlocks& own, std::int32_t block, const Unsettled* unsettled,
            BlockTest& test);
  /// Decides what has been noted since clear(), in the masks of the tests.
  void settle(const PairFilter& filter) const;
  std::size_t memory_bytes() const { return open_.capacity() * sizeof(OpenPair); }

 private:
  struct OpenPair {
    std::int32_t i, j;
    std::uint32_t* mask;
    std::uint32_t bit;
  };
  std::vector<OpenPair> open_;  ///< and room for more
  std::size_t count_ = 0;
};

}  // namespace dch::detail
