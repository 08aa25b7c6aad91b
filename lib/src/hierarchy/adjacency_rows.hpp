// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <dch/base/index_count.hpp>
#include <dch/base/span.hpp>

namespace dch::detail {

/// Rows of node indices in one flat array. A row that outgrows its place moves to the end of the array with
/// room to spare; the holes are closed once they outweigh the live entries.
class AdjacencyRows {
 public:
  void clear() {
    data_.clear();
    offset_.clear();
    count_.clear();
    capacity_.clear();
    live_ = 0;
  }
  /// Makes rows [0, n) exist.
  void resize(std::size_t n) {
    offset_.resize(n, 0);
    count_.resize(n, 0);
    capacity_.resize(n, 0);
  }
  Span<const std::int32_t> row(std::int32_t k) const {
    return {data_.data() + offset_[k], static_cast<std::size_t>(count_[k])};
  }
  /// Makes room for that many entries in all.
  void reserve(std::int64_t entries) { data_.reserve(static_cast<std::size_t>(entries)); }
  /// Replaces an empty row.
  void assign(std::int32_t k, const std::int32_t* values, std::int32_t count) {
    // Whole levels of rows are most of the memory of a sparse scene: little is kept in reserve.
    if (data_.size() + static_cast<std::size_t>(count) > data_.capacity())
      data_.reserve(data_.size() + data_.size() / 8 + static_cast<std::size_t>(count));
    offset_[k] = static_cast<std::int64_t>(data_.size());
    count_[k] = capacity_[k] = count;
    data_.insert(data_.end(), values, values + count);
    live_ += count;
  }
  void push(std::int32_t k, std::int32_t value) {
    if (count_[k] == capacity_[k]) relocate(k);
    data_[static_cast<std::size_t>(offset_[k] + count_[k]++)] = value;
    ++live_;
  }
  void erase(std::int32_t k, std::int32_t value) {
    std::int32_t* begin = data_.data() + offset_[k];
    std::int32_t* end = begin + count_[k];
    std::int32_t* at = std::find(begin, end, value);
    if (at == end) return;
    *at = *(end - 1);
    --count_[k];
    --live_;
  }
  void clear_row(std::int32_t k) {
    live_ -= count_[k];
    count_[k] = capacity_[k] = 0;
  }
  std::int64_t entries() const { return live_; }
  std::size_t memory_bytes() const {
    return data_.capacity() * sizeof(std::int32_t) + offset_.capacity() * sizeof(std::int64_t) +
           (count_.capacity() + capacity_.capacity()) * sizeof(std::int32_t);
  }

 private:
  void relocate(std::int32_t k) {
    if (data_.size() > 1024 && static_cast<std::int64_t>(data_.size()) > 3 * live_) compact();
    const auto grown = static_cast<std::int32_t>(
        std::min(std::int64_t{capacity_[k]} + capacity_[k] / 2 + 4, kMaxIndexCount));
    const std::size_t at = data_.size();
    data_.resize(at + static_cast<std::size_t>(grown));
    std::copy_n(data_.begin() + offset_[k], count_[k], data_.begin() + static_cast<std::int64_t>(at));
    offset_[k] = static_cast<std::int64_t>(at);
    capacity_[k] = grown;
  }
  void compact() {
    std::vector<std::int32_t> packed;
    packed.reserve(static_cast<std::size_t>(live_ + live_ / 4));
    for (std::size_t k = 0; k < offset_.size(); ++k) {
      const auto begin = data_.begin() + offset_[k];
      offset_[k] = static_cast<std::int64_t>(packed.size());
      packed.insert(packed.end(), begin, begin + count_[k]);
      capacity_[k] = count_[k];
    }
    data_.swap(packed);
  }

  std::vector<std::int32_t> data_;
  std::vector<std::int64_t> offset_;
  std::vector<std::int32_t> count_, capacity_;
  std::int64_t live_ = 0;
};

}  // namespace dch::detail
