// SPDX-License-Identifier: MIT
#include "pair_tournament.hpp"

#include <algorithm>

namespace dch::kinetic {

void PairTournament::clear() {
  const std::int64_t made = made_, lost = lost_;
  *this = PairTournament();
  made_ = made;
  lost_ = lost;
}

std::int32_t PairTournament::add(const Contender& contender, double now) {
  if (free_.empty()) widen(now);
  const std::int32_t slot = free_.back();
  free_.pop_back();
  contenders_[static_cast<std::size_t>(slot)] = contender;
  is_there_[static_cast<std::size_t>(slot)] = 1;
  ++count_;
  play_above(slot, now);
  return slot;
}

void PairTournament::remove(std::int32_t slot, double now) {
  is_there_[static_cast<std::size_t>(slot)] = 0;
  free_.push_back(slot);
  --count_;
  play_above(slot, now);
}

void PairTournament::change(std::int32_t slot, const PairPath& path, double now) {
  contenders_[static_cast<std::size_t>(slot)].path = path;
  play_above(slot, now);
}

/// Twice as many slots. Those that are there stay where they are; all nodes have other numbers.
void PairTournament::widen(double now) {
  const std::size_t before = leaves_;
  contenders_.resize(2 * before);
  is_there_.resize(2 * before, 0);
  nodes_.assign(2 * before, {});
  for (std::size_t slot = 2 * before; slot-- > before;) free_.push_back(static_cast<std::int32_t>(slot));
  leaves_ = 2 * before;
  certificates_ = 0;
  for (std::size_t k = leaves_ - 1; k > 0; --k) play(k, now);
}

/// Of a node whose children are in order.
void PairTournament::play(std::size_t k, double now) {
  Node& match = nodes_[k];
  const std::int32_t a = winner(2 * k), b = winner(2 * k + 1);
  certificates_ -= match.has_match;
  match.winner = a < 0 ? b : a;
  match.fails = kNever;
  match.has_match = a >= 0 && b >= 0;
  if (match.has_match) {
    ++certificates_;
    ++made_;
    const DistanceOrder order(of(a).path, of(b).path);
    const int sign = order.sign_after(now);
    const bool is_first = sign != 0 ? sign < 0 : of(a).edge < of(b).edge;
    match.winner = is_first ? a : b;
    match.fails = order.next_change(now);
  }
  match.next = next_of(k);
}

/// Plays the matches that a contender has part in, or had.
void PairTournament::play_above(std::int32_t slot, double now) {
  bool has_part = true;
  for (std::size_t k = (leaves_ + static_cast<std::size_t>(slot)) / 2; k > 0; k /= 2) {
    Node& match = nodes_[k];
    if (!has_part) {
      match.next = next_of(k);
      continue;
    }
    const std::int32_t before = match.winner;
    play(k, now);
    has_part = match.winner != before || match.winner == slot;
  }
}

/// From the leaves up, so that a match that is played has its winners. Returns whether the winner is another
/// one.
bool PairTournament::mend(std::size_t k, double now) {
  if (!(next(k) <= now)) return false;
  const bool left = mend(2 * k, now), right = mend(2 * k + 1, now);
  Node& match = nodes_[k];
  const bool fails = match.fails <= now;
  if (!left && !right && !fails) {
    match.next = next_of(k);
    return false;
  }
  const std::int32_t before = match.winner;
  play(k, now);
  lost_ += fails;
  return match.winner != before;
}

std::int64_t PairTournament::certificates_of(std::int32_t slot) const {
  std::int64_t count = 0;
  for (std::size_t k = leaves_ + static_cast<std::size_t>(slot); k > 1 && winner(k) == slot; k /= 2)
    count += nodes_[k / 2].has_match;
  return count;
}

}  // namespace dch::kinetic
