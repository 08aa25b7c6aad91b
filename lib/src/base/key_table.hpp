// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/span.hpp>

namespace dch::detail {

/// Index of each of a set of distinct 64-bit keys: open addressing, filled at once, then only read.
/// (std::unordered_map took longer than the repair that it served.) Places hold indices alone: 14 to 20 bytes
/// a key in all, where entries with their keys took up to 64.
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
    while (buckets < keys.size() + keys.size() / 2) buckets *= 2;
    keys_.assign(keys.begin(), keys.end());
    indices_.assign(buckets, kAbsent);
    mask_ = buckets - 1;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      std::int32_t& index = indices_[slot_of(keys[i])];
      if (index != kAbsent)
        throw InvalidParameter("update(): key " + std::to_string(keys[i]) + " of particle " +
                               std::to_string(i) + " names an earlier particle too; keys must be distinct");
      index = static_cast<std::int32_t>(i);
    }
  }
  /// Those of the last fill().
  const std::vector<std::uint64_t>& keys() const { return keys_; }
  std::int32_t find(std::uint64_t key) const { return indices_.empty() ? kAbsent : indices_[slot_of(key)]; }

 private:
  /// Where the key is, or the empty place where it would go; the table is at most two thirds full.
  std::size_t slot_of(std::uint64_t key) const {
    std::uint64_t hash = key * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
    std::size_t slot = hash & mask_;
    while (indices_[slot] != kAbsent && keys_[static_cast<std::size_t>(indices_[slot])] != key)
      slot = (slot + 1) & mask_;
    return slot;
  }

  std::vector<std::uint64_t> keys_;    ///< in the order given
  std::vector<std::int32_t> indices_;  ///< by place
  std::size_t mask_ = 0;
};

}  // namespace dch::detail
