// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dch::lammps {

/// Index of an atom by its ID: an array, or where IDs are far apart open addressing, at most half full.
class TagTable {
 public:
  static constexpr std::int32_t kAbsent = -1;

  /// Forgets all, and makes room for so many IDs.
  /// @param largest of them
  void reset(std::size_t entries, std::int64_t largest) {
    constexpr std::size_t kDense =
        4;  ///< IDs for each that there is, below which an array takes least memory
    tag_.clear();
    is_dense_ = static_cast<std::size_t>(largest) < kDense * entries;
    if (is_dense_) {
      index_.assign(static_cast<std::size_t>(largest) + 1, kAbsent);
      return;
    }
    std::size_t slots = 16;
    while (slots < 2 * entries) slots *= 2;
    tag_.assign(slots, 0);
    index_.resize(slots);
  }
  /// The index that was added with this ID first, which is `candidate` if there was none. IDs are positive.
  std::int32_t find_or_add(std::int64_t tag, std::int32_t candidate) {
    if (is_dense_) {
      std::int32_t& index = index_[static_cast<std::size_t>(tag)];
      if (index == kAbsent) index = candidate;
      return index;
    }
    const std::size_t slot = slot_of(tag);
    if (tag_[slot] == tag) return index_[slot];
    tag_[slot] = tag;
    index_[slot] = candidate;
    return candidate;
  }
  std::int32_t find(std::int64_t tag) const {
    if (is_dense_)
      return static_cast<std::size_t>(tag) < index_.size() ? index_[static_cast<std::size_t>(tag)] : kAbsent;
    if (tag_.empty()) return kAbsent;
    const std::size_t slot = slot_of(tag);
    return tag_[slot] == tag ? index_[slot] : kAbsent;
  }

 private:
  /// Where the ID is, or the free slot where it would go.
  std::size_t slot_of(std::int64_t tag) const {
    const std::size_t mask = tag_.size() - 1;
    std::size_t slot = (static_cast<std::uint64_t>(tag) * 0x9E3779B97F4A7C15u >> 20) & mask;
    while (tag_[slot] != 0 && tag_[slot] != tag) slot = (slot + 1) & mask;
    return slot;
  }

  bool is_dense_ = false;          ///< index_ is by ID, and there is no tag_
  std::vector<std::int64_t> tag_;  ///< 0 marks a free slot
  std::vector<std::int32_t> index_;
};

}  // namespace dch::lammps
