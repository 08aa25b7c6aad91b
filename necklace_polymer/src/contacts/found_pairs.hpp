// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/engines/pair_search.hpp>

namespace dch::necklace::detail {

/// Pairs of places in contact. They are sorted before contacts are made of them, which are four times as
/// large and read the beads in order then.
class FoundPairs {
 public:
  struct Pair {
    std::uint64_t key;  ///< the particles, the lower one in the upper half
    IndexPair places;   ///< that of the lower particle first
    std::int32_t i() const { return static_cast<std::int32_t>(key >> 32); }
    std::int32_t j() const { return static_cast<std::int32_t>(key & 0xffffffffU); }
  };

  /// @param particle the particles by place
  explicit FoundPairs(Span<const std::int32_t> particle) : particle_(particle) {}

  void add(std::int32_t p, std::int32_t q) {
    auto i = static_cast<std::uint64_t>(particle_[static_cast<std::size_t>(p)]);
    auto j = static_cast<std::uint64_t>(particle_[static_cast<std::size_t>(q)]);
    if (i > j) std::swap(i, j), std::swap(p, q);
    pairs_.push_back({i << 32 | j, {p, q}});
  }
  void add(FoundPairs&& others) {
    if (pairs_.empty()) return pairs_.swap(others.pairs_);
    // Not insert(), of which GCC 14 warns wrongly that it writes beyond the end.
    pairs_.resize(pairs_.size() + others.pairs_.size());
    std::copy(others.pairs_.begin(), others.pairs_.end(), pairs_.end() - std::ssize(others.pairs_));
  }
  /// In ascending order of particles. O(c lg c) for c contacts; O(c) if the particles are not many more than
  /// the contacts and none has many.
  const std::vector<Pair>& sorted(Executor* executor) {
    std::uint64_t last = 0;
    for (const Pair& pair : pairs_) last = std::max(last, pair.key >> 32);
    if (pairs_.size() < last / 8) {
      sort(pairs_.begin(), pairs_.end());
    } else {
      sort_by_rows(last, executor);
    }
    return pairs_;
  }

 private:
  using Iterator = std::vector<Pair>::iterator;

  static void sort(Iterator first, Iterator last) {
    std::sort(first, last, [](const Pair& a, const Pair& b) { return a.key < b.key; });
  }

  /// Counts the contacts of each lower particle, of which `last_row` is the last, puts them together, and
  /// sorts what one has.
  void sort_by_rows(std::uint64_t last_row, Executor* executor) {
    std::vector<std::size_t> end(last_row + 2, 0);
    for (const Pair& pair : pairs_) ++end[(pair.key >> 32) + 1];
    for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
    std::vector<Pair> rows(pairs_.size());
    for (const Pair& pair : pairs_) rows[end[pair.key >> 32]++] = pair;
    pairs_.swap(rows);
    const auto at = [&](std::size_t k) { return pairs_.begin() + static_cast<std::ptrdiff_t>(k); };
    for_ranges(executor, last_row + 1, [&](std::uint64_t first, std::uint64_t last) {
      for (std::uint64_t i = first; i < last; ++i) sort(at(i == 0 ? 0 : end[i - 1]), at(end[i]));
    });
  }

  Span<const std::int32_t> particle_;
  std::vector<Pair> pairs_;
};

}  // namespace dch::necklace::detail
