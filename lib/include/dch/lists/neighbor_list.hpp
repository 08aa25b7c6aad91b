// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>

#pragma GCC visibility push(default)
namespace dch {

enum class ListKind {
  half,  ///< each pair once, in the row of its smaller index
  full   ///< each pair in both rows
};

/// How a list is laid out.
enum class RowOrder {
  by_index,  ///< row i is particle i, neighbors ascending, each pair of a half list in the row of its smaller
             ///< index
  unsorted,  ///< rows and neighbors as they lie in the engine's structure, close to each other in space, each
             ///< pair of a half list in either row: several times faster to make, and kind to caches
  by_structure = unsorted  ///< the name of before, for one version
};

/// Neighbor list in CSR form; the neighbors of row k are j[first[k]] .. j[first[k+1]-1].
struct NeighborList {
  ListKind kind = ListKind::half;
  std::vector<std::int64_t> first{0};
  std::vector<std::int32_t> j{};         ///< may be longer than first.back() if unsorted
  std::vector<std::int32_t> particle{};  ///< whose row it is; empty if row k is particle k
  /// By row, the end of the neighbors before the shell (ListParams::shell); empty if none was asked for or
  /// the order is by index.
  std::vector<std::int64_t> near_end{};
  double margin =
      0;  ///< no pair is farther apart than its cutoff + skin + margin [length]; 0 for exact lists

  /// Number of rows (particles).
  std::size_t size() const { return first.size() - 1; }
  /// Number of distinct pairs; O(1) for a half list, O(entries) for a full one, whose rows of ghosts are
  /// empty.
  std::int64_t pairs() const;
  Span<const std::int32_t> row(std::size_t i) const {
    return {j.data() + first[i], static_cast<std::size_t>(first[i + 1] - first[i])};
  }
};

}  // namespace dch
#pragma GCC visibility pop
