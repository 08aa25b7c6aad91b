// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/lists/neighbor_list.hpp>

namespace dch::cli {

/// Gathers, over the lists of all frames, how many neighbors atoms have, and a hash that two runs share only
/// if their lists are alike.
class ListStatistics {
 public:
  /// @param is_new false if `list` is the list added last, unchanged
  void add(const NeighborList& list, bool is_new);

  /// [k]: number of atoms with k neighbors, summed over the frames. In half lists too a pair counts for both
  /// atoms.
  const std::vector<std::int64_t>& degree_histogram() const { return histogram_; }
  /// FNV-1a over the row ends and neighbors of every frame.
  std::uint64_t hash() const { return hash_; }

 private:
  void count_degrees(const NeighborList& list);

  std::vector<std::int64_t> degrees_;  ///< of the list added last
  std::vector<std::int64_t> last_histogram_;
  std::vector<std::int64_t> histogram_;
  std::uint64_t hash_ = 14695981039346656037ull;
};

}  // namespace dch::cli
