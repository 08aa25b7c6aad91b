// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/lists/list_maker.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "lists/row_finder.hpp"

namespace dch::detail {

/// Makes an empty half list, rows of which are to be appended.
void start_rows(NeighborList& list);

/// Puts lists behind each other: out, then the pieces.
void append_pieces(Executor& executor, const std::vector<const NeighborList*>& pieces, NeighborList& out);

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
    const int shares = kSlicesPerThread * executor->threads();
    parts_.resize(static_cast<std::size_t>(shares));
    executor->run(shares, [&](int share) {
      Part& part = parts_[static_cast<std::size_t>(share)];
      part.lists.resize(out.size());
      for (NeighborList& list : part.lists) start_rows(list);
      find_part(part, share, shares);
    });
    for (std::size_t r = 0; r < out.size(); ++r) {
      std::vector<const NeighborList*> pieces;
      pieces.reserve(parts_.size());
      for (const Part& part : parts_) pieces.push_back(&part.lists[r]);
      append_pieces(*executor, pieces, *out[r]);
    }
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
      for (const NeighborList& piece : part.lists)
        bytes += (piece.first.capacity() + piece.near_end.capacity()) * sizeof(std::int64_t) +
                 (piece.particle.capacity() + piece.j.capacity()) * sizeof(std::int32_t);
    }
    return bytes;
  }

 private:
  /// Slices of the work for each thread, so that none waits long for the last one.
  static constexpr int kSlicesPerThread = 4;
  struct Part {
    Gatherer gatherer;
    RowFinder finder;
    std::vector<NeighborList> lists;
  };
  std::vector<Part> parts_;
};

}  // namespace dch::detail
