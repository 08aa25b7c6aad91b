// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <dch/lists/exclusions.hpp>
#include <dch/lists/neighbor_list.hpp>

namespace dch::detail {

/// Makes lists with `make`, which are empty if that throws.
template <class Make>
void make_or_empty(const std::vector<NeighborList*>& lists, const Make& make) {
  for (NeighborList* list : lists) list->first.assign(1, 0);  // whatever lists there are, first has room then
  try {
    make();
  } catch (...) {
    for (NeighborList* list : lists) {
      list->first.assign(1, 0);
      list->particle.clear();
      list->near_end.clear();
      list->j.clear();
    }
    throw;
  }
}

/// Pairs that an engine found, each once, in any order; the engine keeps the buffer so that its memory is
/// reused.
class PairBuffer {
 public:
  void clear() { pairs_.clear(); }
  /// Adds the pair of two distinct particles, in either order.
  void add(std::int32_t i, std::int32_t j) {
    pairs_.push_back({std::min(i, j), std::max(i, j)});  // no branch: either order is as likely
  }
  /// Calls f(i, j) for each pair, smaller index first.
  template <class F>
  void operator()(const F& f) const {
    for (const auto& [low, high] : pairs_) f(low, high);
  }
  std::size_t memory_bytes() const { return pairs_.capacity() * sizeof(IndexPair); }

 private:
  std::vector<IndexPair> pairs_;
};

/// Turns unordered pairs into neighbor lists with ascending rows, by counting passes instead of a sort of
/// each row: first by the larger index, then, columns ascending, by the smaller one, which leaves every row
/// in order. O(n + pairs). Owns the scratch memory of those passes.
class ListAssembler {
 public:
  /// Writes a list of n rows from pairs (i, j), i < j, that `for_each(f)` hands to f(i, j), the same ones in
  /// the same order each time. In a full list the rows of ghosts (first_ghost and on; none if negative) stay
  /// empty.
  template <class ForEachPair>
  void assemble(std::size_t n, ListKind kind, std::int32_t first_ghost, const ForEachPair& for_each,
                NeighborList& out) {
    out.particle.clear();
    out.near_end.clear();
    out.margin = 0;
    if (kind == ListKind::half) {
      assemble_half(n, for_each, out);
      return;
    }
    const std::size_t rows = first_ghost < 0 ? n : std::min(n, static_cast<std::size_t>(first_ghost));
    assemble_half(n, for_each, half_);
    assemble_full(n, rows, out);
  }
  std::size_t memory_bytes() const;

 private:
  template <class ForEachPair>
  void assemble_half(std::size_t n, const ForEachPair& for_each, NeighborList& out) {
    column_first_.assign(n + 1, 0);
    out.kind = ListKind::half;
    out.first.assign(n + 1, 0);
    for_each([&](std::int32_t low, std::int32_t high) {
      ++out.first[static_cast<std::size_t>(low) + 1];
      ++column_first_[static_cast<std::size_t>(high) + 1];
    });
    accumulate_counts(out.first);
    accumulate_counts(column_first_);
    row_of_.resize(static_cast<std::size_t>(out.first.back()));
    next_.assign(column_first_.begin(), column_first_.end());
    for_each([&](std::int32_t low, std::int32_t high) { row_of_[next_[high]++] = low; });
    fill_rows(n, out);
  }
  static void accumulate_counts(std::vector<std::int64_t>& first);
  void fill_rows(std::size_t n, NeighborList& out);
  void assemble_full(std::size_t n, std::size_t rows, NeighborList& out);

  std::vector<std::int64_t> column_first_;  ///< start of each column in row_of_
  std::vector<std::int32_t> row_of_;        ///< smaller indices, by larger index
  std::vector<std::int64_t> next_;          ///< where the next entry of each row goes
  NeighborList half_;                       ///< upper triangle on the way to a full list
};

}  // namespace dch::detail
