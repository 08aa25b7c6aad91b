// SPDX-License-Identifier: MIT
#include "lists/open_pairs.hpp"

#include <algorithm>

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

}  // namespace

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
