// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/kinetic/kinetic_edges.hpp>

namespace dch::kinetic {

/// What is next for a point. Ordered by time, then by ids, so that the order never depends on a history.
struct Due {
  double time;
  Edge edge;  ///< {point, -1} where no other point has part in it
  std::int32_t pair = -1;

  bool operator<(const Due& other) const {
    return time != other.time ? time < other.time : edge < other.edge;
  }
};

/// One entry for each point, the earliest on top. A tournament: each node of a binary tree holds the earlier
/// of the two below it. Most changes are of points that lose their first matches before and after, and stop
/// there.
class PointQueue {
 public:
  explicit PointQueue(std::size_t points) {
    while (leaves_ < points) leaves_ *= 2;
    for (std::size_t i = 0; i < points; ++i) entries_.push_back({kNever, {static_cast<std::int32_t>(i), -1}});
    winners_.assign(leaves_, -1);
    for (std::size_t node = leaves_ - 1; node > 0; --node) winners_[node] = match(node);
  }

  bool empty() const { return entries_.empty(); }
  const Due& top() const { return entries_[leaves_ > 1 ? static_cast<std::size_t>(winners_[1]) : 0]; }
  const Due& of(std::int32_t point) const { return entries_[static_cast<std::size_t>(point)]; }
  void set(std::int32_t point, const Due& due) {
    entries_[static_cast<std::size_t>(point)] = due;
    for (std::size_t node = (leaves_ + static_cast<std::size_t>(point)) / 2; node > 0; node /= 2) {
      const std::int32_t winner = match(node);
      if (winner == winners_[node] && winner != point) return;
      winners_[node] = winner;
    }
  }

 private:
  /// -1 for none.
  std::int32_t winner_below(std::size_t node) const {
    if (node < leaves_) return winners_[node];
    return node - leaves_ < entries_.size() ? static_cast<std::int32_t>(node - leaves_) : -1;
  }
  std::int32_t match(std::size_t node) const {
    const std::int32_t a = winner_below(2 * node), b = winner_below(2 * node + 1);
    return b < 0 || (a >= 0 && of(a) < of(b)) ? a : b;
  }

  std::size_t leaves_ = 1;             ///< a power of two; leaf k has the number leaves_ + k, the root 1
  std::vector<Due> entries_;           ///< by point
  std::vector<std::int32_t> winners_;  ///< by node
};

}  // namespace dch::kinetic
