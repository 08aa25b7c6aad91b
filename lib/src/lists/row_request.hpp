// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lists/list_limits.hpp"
#include "lists/pair_filter.hpp"
#include "simd/list_kernels.hpp"

namespace dch::detail {

/// A list whose rows are wanted.
struct RowRequest {
  const PairFilter* filter;
  ListLimits limits;
};

/// Copies those of the candidates that may be near enough to a box of points for some pair of them to be in
/// the list, as ListKernels::filter does, and returns how many.
/// @param size the largest of the points in the box, where cutoffs go by radii
inline std::int32_t keep_near(const ListKernels& kernels, const ListLimits& limits, const BlockSpan& span,
                              std::int16_t size, const Candidates& from, const std::uint32_t* valid,
                              std::int32_t count, const Candidates& to) {
  if (limits.by == CutoffBy::radii)
    return kernels.filter_by_size(span, static_cast<std::int16_t>(size + limits.all.skin), limits.all.band,
                                  from, valid, count, to);
  if (limits.by == CutoffBy::types && !limits.per_pair)
    return kernels.filter_by_type(span, limits.farthest, from, valid, count, to);
  return kernels.filter(span, limits.all.out, from, valid, count, to);
}

inline std::int32_t rounded_up(std::int32_t n, std::int32_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

/// Calls f(first, last) for groups of at most that many blocks, so cut that those of one group are close
/// together: where order_by_halving() has cut.
template <class F>
void for_each_group(std::int32_t first, std::int32_t blocks, std::int32_t most, const F& f) {
  if (blocks <= most) {
    if (blocks > 0) f(first, first + blocks);
    return;
  }
  for_each_group(first, blocks / 2, most, f);
  for_each_group(first + blocks / 2, blocks - blocks / 2, most, f);
}

}  // namespace dch::detail
