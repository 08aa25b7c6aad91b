// SPDX-License-Identifier: MIT
#include "lists/ordered_rows.hpp"

#include <algorithm>

namespace dch::detail {
namespace {

/// Of what a list held, more that the next one may hold without being copied once more.
constexpr std::size_t kMore = 32;

void resize_to_capacity(NeighborList& list) {
  list.first.resize(list.particle.capacity() + 1);
  list.particle.resize(list.particle.capacity());
  if (list.near_end.capacity() > 0) list.near_end.resize(list.particle.size());
}

}  // namespace

void start_rows(NeighborList& list) {
  list.kind = ListKind::half;
  list.first.assign(1, 0);
  list.particle.clear();
  list.near_end.clear();
  list.margin = 0;
}

OrderedRows::OrderedRows(const std::vector<NeighborList*>& out, int pieces)
    : out_(out),
      pieces_(pieces),
      begin_((static_cast<std::size_t>(pieces) + 1) * out.size()),
      is_counted_(static_cast<std::size_t>(pieces)),
      has_shell_(out.size()) {
  for (std::size_t r = 0; r < out.size(); ++r) {
    begin(0, r) = {out[r]->size(), static_cast<std::size_t>(out[r]->first.back())};
    has_shell_[r] = static_cast<char>(!out[r]->near_end.empty());
    resize_to_capacity(*out[r]);
  }
}

void OrderedRows::count(int piece, const NeighborList* lists) {
  const std::lock_guard lock(counting_);
  for (std::size_t r = 0; r < out_.size(); ++r) {
    begin(piece + 1, r) = {lists[r].size(), static_cast<std::size_t>(lists[r].first.back())};
    if (!lists[r].near_end.empty()) has_shell_[r] = 1;
  }
  is_counted_[static_cast<std::size_t>(piece)] = 1;
  int known = known_.load(std::memory_order_relaxed);
  for (; known < pieces_ && is_counted_[static_cast<std::size_t>(known)] != 0; ++known)
    for (std::size_t r = 0; r < out_.size(); ++r) {
      begin(known + 1, r).rows += begin(known, r).rows;
      begin(known + 1, r).entries += begin(known, r).entries;
    }
  known_.store(known, std::memory_order_release);
}

bool OrderedRows::has_room(std::size_t list, const NeighborList& piece, const Extent& at) const {
  const NeighborList& out = *out_[list];
  return at.rows + piece.size() <= out.particle.size() &&
         (piece.near_end.empty() || at.rows + piece.size() <= out.near_end.size()) &&
         at.entries + static_cast<std::size_t>(piece.first.back()) <= out.j.size();
}

bool OrderedRows::place(int piece, const NeighborList* lists) const {
  if (known_.load(std::memory_order_acquire) < piece) return false;
  for (std::size_t r = 0; r < out_.size(); ++r)
    if (!has_room(r, lists[r], begin(piece, r))) return false;
  for (std::size_t r = 0; r < out_.size(); ++r) {
    const NeighborList& from = lists[r];
    const Extent at = begin(piece, r);
    NeighborList& out = *out_[r];
    std::copy(from.particle.begin(), from.particle.end(),
              out.particle.begin() + static_cast<std::ptrdiff_t>(at.rows));
    std::copy_n(from.j.data(), from.first.back(), out.j.data() + at.entries);
    const auto before = static_cast<std::int64_t>(at.entries);
    for (std::size_t k = 0; k < from.near_end.size(); ++k)
      out.near_end[at.rows + k] = before + from.near_end[k];
    for (std::size_t k = 0; k < from.size(); ++k) out.first[at.rows + k + 1] = before + from.first[k + 1];
  }
  return true;
}

void OrderedRows::make_room() {
  for (std::size_t r = 0; r < out_.size(); ++r) {
    NeighborList& out = *out_[r];
    const Extent all = begin(pieces_, r);
    out.first.resize(all.rows + 1);
    out.particle.resize(all.rows);
    out.near_end.resize(has_shell_[r] != 0 ? all.rows : 0);
    if (out.j.size() >= all.entries) continue;
    out.j.reserve(all.entries + all.entries / kMore);
    out.j.resize(out.j.capacity());
  }
}

}  // namespace dch::detail
