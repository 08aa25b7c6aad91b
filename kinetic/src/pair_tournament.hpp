// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/kinetic/kinetic_edges.hpp>

#include "distance_order.hpp"

namespace dch::kinetic {

/// A kinetic tournament of pairs: who is the closest, at every time. Each node of a binary tree holds the
/// closer of the two pairs below it, and when it will be that no more (its certificate); of pairs equally
/// close for good, the one with the smaller ids. A pair that comes, goes or changes costs O(lg n)
/// certificates, and so does one that fails.
class PairTournament {
 public:
  /// A pair and one image of it.
  struct Contender {
    Edge edge;
    PairPath path;
  };

  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }
  void clear();
  /// Returns the slot that the contender has until it is removed.
  std::int32_t add(const Contender& contender, double now);
  void remove(std::int32_t slot, double now);
  /// The contender has another path from now on.
  void change(std::int32_t slot, const PairPath& path, double now);

  const Contender& of(std::int32_t slot) const { return contenders_[static_cast<std::size_t>(slot)]; }
  /// The closest pair, by its ids; -1 where there is none.
  Edge closest() const { return nodes_[1].winner < 0 ? Edge{} : of(nodes_[1].winner).edge; }
  /// When the first certificate fails.
  double next() const { return nodes_[1].next; }
  /// Mends all certificates that fail now.
  void advance(double now) { mend(1, now); }

  // Counts
  std::int64_t certificates() const { return certificates_; }  ///< that there are
  std::int64_t certificates_of(std::int32_t slot) const;       ///< of a contender
  std::int64_t made() const { return made_; }                  ///< since the start
  std::int64_t lost() const { return lost_; }                  ///< of them those whose winner lost in time

 private:
  struct Node {
    std::int32_t winner = -1;  ///< slot
    bool has_match = false;    ///< whether there are two to compare: a certificate
    double fails = kNever;     ///< of its own certificate
    double next = kNever;      ///< of all from here on down
  };
  void play(std::size_t k, double now);
  bool mend(std::size_t k, double now);
  void play_above(std::int32_t slot, double now);
  void widen(double now);
  Node& node(std::size_t k) { return nodes_[k]; }
  std::int32_t winner(std::size_t k) const {
    if (k < leaves_) return nodes_[k].winner;
    return is_there_[k - leaves_] ? static_cast<std::int32_t>(k - leaves_) : -1;
  }
  double next(std::size_t k) const {
    if (k < leaves_) return nodes_[k].next;
    return kNever;
  }
  double next_of(std::size_t k) const { return std::min({nodes_[k].fails, next(2 * k), next(2 * k + 1)}); }

  std::size_t leaves_ = 2;  ///< a power of two; leaf k has the number leaves_ + k, the root 1
  std::size_t count_ = 0;
  std::vector<Contender> contenders_ = std::vector<Contender>(2);  ///< by slot
  std::vector<char> is_there_ = std::vector<char>(2, 0);           ///< by slot
  std::vector<std::int32_t> free_{1, 0};                           ///< slots, the next one last
  std::vector<Node> nodes_ = std::vector<Node>(2);
  std::int64_t certificates_ = 0, made_ = 0, lost_ = 0;
};

}  // namespace dch::kinetic
