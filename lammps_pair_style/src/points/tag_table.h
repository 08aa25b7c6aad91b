// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dch::lammps {

/// Index of an atom by its ID: open addressing, at most half full.
class TagTable {
 public:
  static constexpr std::int32_t kAbsent = -1;

  /// Forgets all, and makes room for so many IDs.
  void reset(std::size_t entries) {
    std::size_t slots = 16;
    while (slots < 2 * entries) slots *= 2;
    tag_.assign(slots, 0);
    index_.resize(slots);
  }
  /// The index that was added with this ID first, which is `candidate` if there was none. IDs are positive.
  std::int32_t find_or_add(std::int64_t tag, std::int32_t candidate) {
    const std::size_t slot = slot_of(tag);
    if (tag_[slot] == tag) return index_[slot];
    tag_[slot] = tag;
    index_[slot] = candidate;
    return candidate;
  }
  std::int32_t find(std::int64_t tag) const {
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

  std::vector<std::int64_t> tag_;  ///< 0 marks a free slot
  std::vector<std::int32_t> index_;
};

}  // namespace dch::lammps
