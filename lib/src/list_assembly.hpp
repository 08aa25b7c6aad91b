// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <dch/exclusions.hpp>
#include <dch/neighbor_list.hpp>

namespace dch::detail {

/// Pairs that an engine found, each once, in any order; the engine keeps the buffer so that its memory is
/// reused.
class PairBuffer {
 public:
  void clear() { pairs_.clear(); }
  /// Adds the pair of two distinct particles, in either order.
  void add(std::int32_t i, std::int32_t j) {
    pairs_.push_back({std::min(i, j), std::max(i, j)});  // no branch: either order is as likely
  }
  /// The pairs, smaller index first.
  Span<const IndexPair> pairs() const { return pairs_; }
  std::size_t memory_bytes() const { return pairs_.capacity() * sizeof(IndexPair); }

 private:
  std::vector<IndexPair> pairs_;
};

/// Turns unordered pairs into neighbor lists with ascending rows, by counting passes instead of a sort of
/// each row: first by the larger index, then, columns ascending, by the smaller one, which leaves every row
/// in order. O(n + pairs). Owns the scratch memory of those passes.
class ListAssembler {
 public:
  /// Writes a list of n rows. In a full list the rows of ghosts (first_ghost and on; none if negative) stay
  /// empty.
  void assemble(std::size_t n, ListKind kind, std::int32_t first_ghost, const PairBuffer& buffer,
                NeighborList& out);
  std::size_t memory_bytes() const;

 private:
  void assemble_half(std::size_t n, Span<const IndexPair> pairs, NeighborList& out);
  void assemble_full(std::size_t n, std::size_t rows, NeighborList& out);

  std::vector<std::int64_t> column_first_;  ///< start of each column in row_of_, then its end while filling
  std::vector<std::int32_t> row_of_;        ///< smaller indices, by larger index
  std::vector<std::int64_t> next_;          ///< where the next entry of each row goes
  NeighborList half_;                       ///< upper triangle on the way to a full list
};

}  // namespace dch::detail
