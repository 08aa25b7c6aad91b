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

void OpenPairs::note(const RowRequest& request, const OwnBlocks& own, std::int32_t block,
                     const Unsettled* unsettled, BlockTest& test) {
  const ListLimits& limits = request.limits;
  if (request.filter->params().superset || limits.per_pair) {
    for (std::int32_t u = 0; u < test.left; ++u)
      test.mask[unsettled[u].row * test.chunks + unsettled[u].chunk] |= unsettled[u].lanes;
    return;
  }
  const Candidates near = test.near.at(0);
  for (std::int32_t u = 0; u < test.left; ++u) {
    const auto [row, chunk, open] = unsettled[u];
    std::uint32_t& mask = test.mask[row * test.chunks + chunk];
    if (open_.size() < count_ + kChunk) open_.resize(2 * count_ + kChunk);
    for (std::uint32_t rest = row < own.count[block] ? open : 0; rest != 0; rest &= rest - 1) {
      // Without branches: whether a pair is near enough is hard to foretell.
      const int lane = __builtin_ctz(rest);
      const std::int32_t at = chunk * kChunk + lane;
      const double d2 = squared_distance(own.points[block], row, near, at);
      const double cutoff = cutoff_of(limits, own, block, row, near.tag[at]);
      const double less = std::max(cutoff - limits.off, 0.0), more = cutoff + limits.off;
      const bool is_in = d2 < less * less;
      mask |= static_cast<std::uint32_t>(is_in) << lane;
      OpenPair& pair = open_[count_];
      pair = {own.particle[block][row], near.id[at], &mask, 1u << lane};
      request.filter->ask_for(pair.i, pair.j);
      count_ += static_cast<std::size_t>(!is_in) & static_cast<std::size_t>(d2 <= more * more);
    }
  }
}

/// Their positions are likely in no cache; they have been asked for together.
void OpenPairs::settle(const PairFilter& filter) const {
  for (std::size_t k = 0; k < count_; ++k)
    if (filter.accept(open_[k].i, open_[k].j)) *open_[k].mask |= open_[k].bit;
}

}  // namespace dch::detail
