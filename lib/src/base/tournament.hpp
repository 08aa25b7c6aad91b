// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dch::detail {

/// Entries with numbers, the least on top. Each node of a binary tree holds the lesser of the two below it,
/// so a change costs O(lg n). Most changes are of entries that lose their first matches before and after, and
/// stop there.
/// @tparam Entry ordered by <; of several that are equal the one with the smallest number is on top
template <class Entry>
class Tournament {
 public:
  Tournament() = default;
  explicit Tournament(std::vector<Entry> entries) : entries_(std::move(entries)) { play_all(); }

  bool empty() const { return entries_.empty(); }
  std::size_t size() const { return entries_.size(); }
  /// Number of the entry on top, where there is one.
  std::int32_t winner() const { return leaves_ > 1 ? winners_[1] : 0; }
  const Entry& top() const { return of(winner()); }
  const Entry& of(std::int32_t number) const { return entries_[static_cast<std::size_t>(number)]; }

  void set(std::int32_t number, const Entry& entry) {
    entries_[static_cast<std::size_t>(number)] = entry;
    for (std::size_t node = (leaves_ + static_cast<std::size_t>(number)) / 2; node > 0; node /= 2) {
      const std::int32_t winner = match(node);
      if (winner == winners_[node] && winner != number) return;
      winners_[node] = winner;
    }
  }
  /// Adds entries at the end. O(n), but O(lg n) an entry in the long run.
  void grow(std::size_t size, const Entry& entry) {
    const std::size_t before = entries_.size();
    entries_.resize(size, entry);
    if (size > leaves_) return play_all();
    for (std::size_t k = before; k < size; ++k) set(static_cast<std::int32_t>(k), entry);
  }

 protected:
  /// For changes of what the order does not depend on.
  Entry& entry(std::int32_t number) { return entries_[static_cast<std::size_t>(number)]; }

 private:
  void play_all() {
    while (leaves_ < entries_.size()) leaves_ *= 2;
    winners_.assign(leaves_, -1);
    for (std::size_t node = leaves_ - 1; node > 0; --node) winners_[node] = match(node);
  }
  /// -1 for none.
  std::int32_t winner_below(std::size_t node) const {
    if (node < leaves_) return winners_[node];
    return node - leaves_ < entries_.size() ? static_cast<std::int32_t>(node - leaves_) : -1;
  }
  std::int32_t match(std::size_t node) const {
    const std::int32_t a = winner_below(2 * node), b = winner_below(2 * node + 1);
    return b < 0 || (a >= 0 && !(of(b) < of(a))) ? a : b;
  }

  std::size_t leaves_ = 1;             ///< a power of two; leaf k has the number leaves_ + k, the root 1
  std::vector<Entry> entries_;         ///< by number
  std::vector<std::int32_t> winners_;  ///< by node
};

}  // namespace dch::detail
