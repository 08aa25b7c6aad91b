// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <dch/base/index_count.hpp>
#include <dch/base/span.hpp>

namespace dch::detail {

/// Rows of node indices. They lie in chunks of memory that never move, so a row that grows costs its own
/// length, however many rows there are. Places that rows have left are given to others about as long.
class AdjacencyRows {
 public:
  /// Keeps the chunks for the rows to come.
  void clear() {
    rows_.clear();
    free_.clear();
    live_ = 0;
    chunk_ = used_ = 0;
  }
  /// Makes rows [0, n) exist.
  void resize(std::size_t n) { rows_.resize(n); }
  Span<const std::int32_t> row(std::int32_t k) const {
    const Row& row = rows_[static_cast<std::size_t>(k)];
    return {row.data, static_cast<std::size_t>(row.count)};
  }
  /// Makes room for that many entries in all, in rows to be assigned.
  void reserve(std::int64_t entries) {
    if (chunks_.empty() && entries > 0) add_chunk(static_cast<std::size_t>(entries));
  }
  /// Replaces an empty row.
  void assign(std::int32_t k, const std::int32_t* values, std::int32_t count) {
    Row& row = rows_[static_cast<std::size_t>(k)];
    // Whole levels of rows are most of the memory of a sparse scene: rows that are all assigned in turn have
    // nothing in reserve.
    if (row.capacity < count) move_to(row, take(free_.empty() ? count : rounded(count)));
    std::copy_n(values, count, row.data);
    row.count = count;
    live_ += count;
  }
  void push(std::int32_t k, std::int32_t value) {
    Row& row = rows_[static_cast<std::size_t>(k)];
    if (row.count == row.capacity)
      move_to(row, take(rounded(std::int64_t{row.capacity} + row.capacity / 2 + 4)));
    row.data[row.count++] = value;
    ++live_;
  }
  void erase(std::int32_t k, std::int32_t value) {
    Row& row = rows_[static_cast<std::size_t>(k)];
    std::int32_t* const end = row.data + row.count;
    std::int32_t* const at = std::find(row.data, end, value);
    if (at == end) return;
    *at = *(end - 1);
    --row.count;
    --live_;
  }
  void clear_row(std::int32_t k) {
    Row& row = rows_[static_cast<std::size_t>(k)];
    live_ -= row.count;
    row.count = 0;
    move_to(row, Place());
  }
  std::int64_t entries() const { return live_; }
  std::size_t memory_bytes() const {
    std::size_t bytes = rows_.capacity() * sizeof(Row) + total_ * sizeof(std::int32_t);
    for (const auto& places : free_) bytes += places.capacity() * sizeof(Place);
    return bytes;
  }

 private:
  struct Place {
    std::int32_t* data = nullptr;
    std::int32_t capacity = 0;
  };
  struct Row : Place {
    std::int32_t count = 0;
  };
  struct Chunk {
    std::unique_ptr<std::int32_t[]> data;
    std::size_t size;
  };
  static constexpr std::size_t kMinChunk = 64, kMaxChunk = std::size_t{1} << 20;

  /// Places of one class hold as many entries as the shortest of them, or up to a quarter more.
  static std::size_t class_of(std::int64_t capacity) {
    std::size_t octave = 0;
    for (std::int64_t rest = capacity; rest >= 8; rest /= 2) ++octave;
    return 4 * octave + static_cast<std::size_t>(capacity >> octave);
  }
  /// The shortest place of a class that holds so many entries.
  static std::int32_t rounded(std::int64_t count) {
    std::int64_t step = 1;
    for (std::int64_t rest = count; rest >= 8; rest /= 2) step *= 2;
    return static_cast<std::int32_t>(std::min((count + step - 1) / step * step, kMaxIndexCount));
  }
  /// The entries move along; the place that they leave is free.
  void move_to(Row& row, Place place) {
    if (row.capacity > 0) {
      std::copy_n(row.data, row.count, place.data);
      const std::size_t kind = class_of(row.capacity);
      if (free_.size() <= kind) free_.resize(kind + 1);
      free_[kind].push_back({row.data, row.capacity});
    }
    row.data = place.data;
    row.capacity = place.capacity;
  }
  Place take(std::int32_t count) {
    const std::size_t kind = class_of(count);
    if (kind < free_.size() && !free_[kind].empty() && free_[kind].back().capacity >= count) {
      const Place place = free_[kind].back();
      free_[kind].pop_back();
      return place;
    }
    const auto wanted = static_cast<std::size_t>(count);
    while (chunk_ < chunks_.size() && chunks_[chunk_].size - used_ < wanted) {
      ++chunk_;
      used_ = 0;
    }
    if (chunk_ == chunks_.size()) add_chunk(std::max(wanted, std::clamp(total_ / 8, kMinChunk, kMaxChunk)));
    const Place place{chunks_[chunk_].data.get() + used_, count};
    used_ += wanted;
    return place;
  }
  void add_chunk(std::size_t size) {
    chunks_.push_back({std::make_unique_for_overwrite<std::int32_t[]>(size), size});
    total_ += size;
  }

  std::vector<Row> rows_;
  std::vector<Chunk> chunks_;
  std::size_t chunk_ = 0, used_ = 0;      ///< the chunk that is being filled, and how far it is
  std::size_t total_ = 0;                 ///< entries of all chunks
  std::vector<std::vector<Place>> free_;  ///< by class
  std::int64_t live_ = 0;
};

}  // namespace dch::detail
