// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/span.hpp>

namespace dch::detail {

/// Index of each of a set of distinct 64-bit keys: open addressing, filled at once, then only read.
/// (std::unordered_map took longer than the repair that it served.)
class KeyTable {
 public:
  static constexpr std::int32_t kAbsent = -1;

  /// Maps keys[i] to i, for the particles of an update().
  /// @throws InvalidParameter unless there is one key for each of n particles, and all are distinct.
  void fill(std::size_t n, Span<const std::uint64_t> keys) {
    if (keys.size() != n)
      throw InvalidParameter("update() got " + std::to_string(keys.size()) + " keys for " +
                             std::to_string(n) + " positions; give one for each, or none");
    std::size_t buckets = 16;
    while (buckets < 2 * keys.size()) buckets *= 2;
    entries_.assign(buckets, {0, kAbsent});
    mask_ = buckets - 1;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      Entry& entry = entries_[slot_of(keys[i])];
      if (entry.index != kAbsent)
        throw InvalidParameter("update(): key " + std::to_string(keys[i]) + " of particle " +
                               std::to_string(i) + " names an earlier particle too; keys must be distinct");
      entry = {keys[i], static_cast<std::int32_t>(i)};
    }
  }
  std::int32_t find(std::uint64_t key) const {
    return entries_.empty() ? kAbsent : entries_[slot_of(key)].index;
  }

 private:
  struct Entry {
    std::uint64_t key;
    std::int32_t index;
  };
  /// Where the key is, or the empty place where it would go; the table is at most half full.
  std::size_t slot_of(std::uint64_t key) const {
    std::uint64_t hash = key * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
    std::size_t slot = hash & mask_;
    while (entries_[slot].index != kAbsent && entries_[slot].key != key) slot = (slot + 1) & mask_;
    return slot;
  }

  std::vector<Entry> entries_;
  std::size_t mask_ = 0;
};

}  // namespace dch::detail
