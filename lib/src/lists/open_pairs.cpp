// SPDX-License-Identifier: MIT
#include "lists/open_pairs.hpp"

#include <algorithm>
#include <cstring>

namespace dch::detail {
namespace {

/// In units, without the roundings of the kernels' squares.
double squared_distance(const BlockPoints& points, std::int32_t row, const Candidates& near,
                        std::int32_t at) {
  const auto square = [](std::int16_t a, std::int16_t b) {
    const double d = static_cast<std::int16_t>(a - b);
    return d * d;
  };
  return square(near.x[at], points.x[row]) + square(near.y[at], points.y[row]) +
         square(near.z[at], points.z[row]);
}

/// Of a point of a block with one that has this tag [units].
double cutoff_of(const ListLimits& limits, const OwnBlocks& own, std::int32_t block, std::int32_t row,
                 std::int16_t tag) {
  switch (limits.by) {
    case CutoffBy::radii:
      return own.tags[block][row] + tag + limits.all.skin;
    case CutoffBy::types:
      return limits.type_cutoff[own.tags[block][row]][tag];
    default:
      return limits.cutoff;
  }
}

/// How many entries more there are after an edit.
std::int32_t more_by(const RowEdit& edit) { return edit.is_missing ? 1 : -1; }

/// Moves the entries between an edit and the next one, which begins at `end`, by some places.
void move_behind(const RowEdit& edit, Span<const std::int32_t> ends, std::int32_t end, std::int32_t by,
                 std::int32_t* ids) {
  const std::int32_t begin = ends[edit.segment] + edit.place + (edit.is_missing ? 0 : 1);
  std::memmove(ids + begin + by, ids + begin, static_cast<std::size_t>(end - begin) * sizeof *ids);
}

}  // namespace

// Neighboring pieces move by one place more or less. So one that moves to the front meets only what has moved
// or gone, and of some that move to the back none meets another if the last is moved first.
void apply_edits(Span<const RowEdit> edits, std::int32_t* ids, Span<std::int32_t> ends) {
  if (edits.empty()) return;
  const auto place_of = [&](const RowEdit& edit) { return ends[edit.segment] + edit.place; };
  const auto move_piece = [&](std::size_t k, std::int32_t by) {
    const std::int32_t end = k + 1 < edits.size() ? place_of(edits[k + 1]) : ends[ends.size() - 1];
    move_behind(edits[k], ends, end, by, ids);
  };
  std::int32_t by = 0;
  for (std::size_t k = 0; k < edits.size();) {
    const std::size_t first = k;
    while (k < edits.size() && by + more_by(edits[k]) > 0) by += more_by(edits[k++]);
    std::int32_t back = by;
    for (std::size_t last = k; last > first; back -= more_by(edits[last])) move_piece(--last, back);
    if (k == edits.size()) break;
    by += more_by(edits[k]);
    move_piece(k++, by);
  }
  by = 0;
  for (const RowEdit& edit : edits) {
    if (edit.is_missing) ids[place_of(edit) + by] = edit.id;
    by += more_by(edit);
  }
  by = 0;
  const RowEdit* edit = edits.begin();
  for (auto segment = static_cast<std::size_t>(edit->segment); segment + 1 < ends.size(); ++segment) {
    for (; edit != edits.end() && edit->segment == static_cast<std::int32_t>(segment); ++edit)
      by += more_by(*edit);
    ends[segment + 1] += by;
  }
}

void OpenPairs::note(const RowRequest& request, const OwnBlocks& own, std::int32_t block, std::int32_t before,
                     const Candidates& near, const OpenLanes* open, std::int32_t open_count) {
  const ListLimits& limits = request.limits;
  for (const OpenLanes* lanes = open; lanes != open + open_count; ++lanes) {
    const std::int32_t row = lanes->row;
    if (open_.size() < count_ + kChunk) open_.resize(2 * count_ + kChunk);
    for (std::uint32_t rest = lanes->lanes; rest != 0; rest &= rest - 1) {
      // Without branches: whether a pair is near enough is hard to foretell.
      const std::uint32_t bit = rest & -rest;
      const std::int32_t at = lanes->chunk * kChunk + __builtin_ctz(rest);
      const double d2 = squared_distance(own.points[block], row, near, at);
      const double cutoff = cutoff_of(limits, own, block, row, near.tag[at]);
      const double less = std::max(cutoff - limits.off, 0.0), more = cutoff + limits.off;
      const bool is_in = d2<less * less, is_out = d2> more * more, is_written = (lanes->within & bit) != 0;
      OpenPair& pair = open_[count_];
      pair.edit = {before + lanes->segment, lanes->before + __builtin_popcount(lanes->within & (bit - 1)),
                   near.id[at], !is_written};
      pair.i = own.particle[block][row];
      pair.is_decided = is_in || is_out;
      request.filter->ask_for(pair.i, pair.edit.id);
      const bool is_right = is_written ? is_in : is_out;
      count_ += static_cast<std::size_t>(!is_right);
    }
  }
}

/// Their positions are likely in no cache; they have been asked for together.
const std::vector<RowEdit>& OpenPairs::decide(const PairFilter& filter) {
  edits_.clear();
  for (std::size_t k = 0; k < count_; ++k) {
    const OpenPair& pair = open_[k];
    if (pair.is_decided || filter.accept(pair.i, pair.edit.id) == pair.edit.is_missing)
      edits_.push_back(pair.edit);
  }
  return edits_;
}

}  // namespace dch::detail
