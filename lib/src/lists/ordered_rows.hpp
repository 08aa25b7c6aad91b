// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/lists/neighbor_list.hpp>

namespace dch::detail {

/// Makes an empty half list, rows of which are to be appended.
void start_rows(NeighborList& list);

/// Puts the rows of pieces behind those that lists have, in the order of the pieces, while threads are still
/// finding others: a piece goes to its place as soon as those before it are counted, if the list has room,
/// and else when all are. So what a thread has found is copied while it is in its cache.
class OrderedRows {
 public:
  OrderedRows(const std::vector<NeighborList*>& out, int pieces);
  /// Says how long the lists of a piece are. Several threads may call it, once for each piece.
  void count(int piece, const NeighborList* lists);
  /// Copies the lists of a piece that was counted, if their places are known and there is room for them.
  /// Several threads may call it.
  bool place(int piece, const NeighborList* lists) const;
  /// Once all pieces are counted, makes lists as long as they are to be. No thread may be placing a piece.
  void make_room();

 private:
  struct Extent {
    std::size_t rows, entries;
  };
  Extent& begin(int piece, std::size_t list) {
    return begin_[static_cast<std::size_t>(piece) * out_.size() + list];
  }
  const Extent& begin(int piece, std::size_t list) const {
    return begin_[static_cast<std::size_t>(piece) * out_.size() + list];
  }
  bool has_room(std::size_t list, const NeighborList& piece, const Extent& at) const;

  const std::vector<NeighborList*>& out_;
  const int pieces_;
  /// By piece and list: of pieces up to known_ where they begin, of others that are counted how long the
  /// piece before is.
  std::vector<Extent> begin_;
  std::vector<char> is_counted_;
  std::vector<char> has_shell_;  ///< by list: pieces with rows have neighbors that are near
  std::atomic<int> known_{0};
  std::mutex counting_;
};

}  // namespace dch::detail
