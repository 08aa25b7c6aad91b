// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/lists/list_maker.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "lists/ordered_rows.hpp"
#include "lists/row_finder.hpp"

namespace dch::detail {

/// Finds the rows of many places (leaves, cells) on several threads, each of which has what it takes: the
/// Gatherer that puts the candidates near a place side by side, and the RowFinder that tests them. The rows
/// do not depend on the number of threads.
template <class Gatherer>
class RowParts {
 public:
  /// Appends rows to lists that start_rows() has made: calls find(gatherer, finder, lists, share, shares) for
  /// each share, which is to append the rows of its part of the places, the shares of places in their order.
  template <class Find>
  void find(Executor* executor, const std::vector<NeighborList*>& out, const Find& find) {
    const auto find_part = [&](Part& part, int share, int shares) {
      part.gatherer.use(instruction_set());
      part.finder.use(instruction_set());
      find(part.gatherer, part.finder, part.lists.data(), share, shares);
    };
    if (!executor || executor->threads() == 1) {
      parts_.resize(1);
      Part& part = parts_.front();
      part.lists.resize(out.size());
      for (std::size_t r = 0; r < out.size(); ++r) std::swap(part.lists[r], *out[r]);
      find_part(part, 0, 1);
      for (std::size_t r = 0; r < out.size(); ++r) std::swap(part.lists[r], *out[r]);
      return;
    }
    find_in_pieces(*executor, out, find_part);
  }

  /// Of all searches so far, with the present number of threads.
  ListWork work() const {
    ListWork work;
    for (const Part& part : parts_) {
      work += part.gatherer.work();
      work.tested += part.finder.tested();
    }
    return work;
  }
  std::size_t memory_bytes() const {
    std::size_t bytes = 0;
    for (const Part& part : parts_) {
      bytes += part.gatherer.memory_bytes() + part.finder.memory_bytes();
      bytes += bytes_of(part.lists);
      for (const Piece& piece : part.spare) bytes += bytes_of(piece.lists);
    }
    return bytes;
  }

 private:
  /// Rows of a share that are not in their place yet.
  struct Piece {
    int share = 0;
    std::vector<NeighborList> lists{};
  };
  struct Part {  // of a thread
    Gatherer gatherer;
    RowFinder finder;
    std::vector<NeighborList> lists;
    std::vector<Piece> waiting, spare;
  };

  /// Shares are small, so that what a thread has found is in its cache when it goes to its place.
  template <class FindPart>
  void find_in_pieces(Executor& executor, const std::vector<NeighborList*>& out, const FindPart& find_part) {
    const int threads = executor.threads();
    std::size_t entries = 0;
    for (const NeighborList* list : out) entries = std::max(entries, list->j.size());
    const int shares =
        std::max(kSharesPerThread * threads,
                 static_cast<int>(std::min(entries / kEntriesOfShare, std::size_t{kMostShares})));
    parts_.resize(static_cast<std::size_t>(threads));
    OrderedRows rows(out, shares);
    std::atomic<int> next{0};
    const auto find_shares = [&](int thread) {
      Part& part = parts_[static_cast<std::size_t>(thread)];
      part.waiting.clear();  // there may be some of lists that were not finished
      for (int share = next++; share < shares; share = next++) {
        part.lists.resize(out.size());
        for (NeighborList& list : part.lists) start_rows(list);
        find_part(part, share, shares);
        rows.count(share, part.lists.data());
        part.waiting.push_back({share, std::move(part.lists)});
        place_waiting(rows, part, kSpare);
        part.lists = {};
        if (part.spare.empty()) continue;
        part.lists = std::move(part.spare.back().lists);
        part.spare.pop_back();
      }
    };
    try {
      executor.run(threads, find_shares);
    } catch (...) {
      for (NeighborList* list : out) start_rows(*list);
      throw;
    }
    rows.make_room();
    executor.run(threads,
                 [&](int thread) { place_waiting(rows, parts_[static_cast<std::size_t>(thread)], 0); });
  }

  /// Keeps the memory of so many pieces for the next ones: not where lists had no room, and pieces are large.
  static void place_waiting(const OrderedRows& rows, Part& part, std::size_t kept) {
    const auto is_placed = [&](Piece& piece) {
      if (!rows.place(piece.share, piece.lists.data())) return false;
      if (part.spare.size() < kept) part.spare.push_back(std::move(piece));
      return true;
    };
    part.waiting.erase(std::remove_if(part.waiting.begin(), part.waiting.end(), is_placed),
                       part.waiting.end());
  }

  static std::size_t bytes_of(const std::vector<NeighborList>& lists) {
    std::size_t bytes = 0;
    for (const NeighborList& list : lists)
      bytes += (list.first.capacity() + list.near_end.capacity()) * sizeof(std::int64_t) +
               (list.particle.capacity() + list.j.capacity()) * sizeof(std::int32_t);
    return bytes;
  }

  /// Shares of the work for each thread at least, so that none waits long for the last one.
  static constexpr int kSharesPerThread = 4;
  static constexpr std::size_t kEntriesOfShare = 1 << 15;  ///< about: 128 kB
  static constexpr int kMostShares = 1 << 14;
  static constexpr std::size_t kSpare = 2;
  std::vector<Part> parts_;
};

}  // namespace dch::detail
