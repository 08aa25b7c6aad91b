// SPDX-License-Identifier: MIT
#include "hierarchy/build/block_order.hpp"

#include <algorithm>
#include <utility>

#include "simd/list_kernels.hpp"

namespace dch::detail {
namespace {

float median(float a, float b, float c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

/// Moves those of points [begin, end) for which `is_first` holds to the front. Without a branch that depends
/// on a coordinate, which would be mispredicted every other time. Returns the end of those.
template <class IsFirst>
std::int32_t partition(LocalPoint* points, std::int32_t begin, std::int32_t end, const IsFirst& is_first) {
  std::int32_t first = begin;
  for (std::int32_t k = begin; k < end; ++k) {
    const LocalPoint p = points[k];
    points[k] = points[first];
    points[first] = p;
    first += is_first(p);
  }
  return first;
}

/// Puts no point with a larger coordinate before `middle` than after it.
void split_at(LocalPoint* points, std::int32_t count, std::int32_t middle, int axis) {
  std::int32_t begin = 0, end = count;
  while (end - begin > 1) {
    const float pivot =
        median(points[begin].at[axis], points[begin + (end - begin) / 2].at[axis], points[end - 1].at[axis]);
    const std::int32_t less =
        partition(points, begin, end, [=](const LocalPoint& p) { return p.at[axis] < pivot; });
    if (middle < less) {
      end = less;
      continue;
    }
    const std::int32_t equal =
        partition(points, less, end, [=](const LocalPoint& p) { return p.at[axis] <= pivot; });
    if (middle < equal) return;
    begin = equal;
  }
}

int longest_side(const LocalPoint* points, std::int32_t count) {
  float low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) low[axis] = high[axis] = points[0].at[axis];
  for (std::int32_t k = 1; k < count; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], points[k].at[axis]);
      high[axis] = std::max(high[axis], points[k].at[axis]);
    }
  }
  const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

void halve(LocalPoint* points, std::int32_t count, std::int32_t blocks) {
  if (blocks <= 1) return;
  const std::int32_t half = blocks / 2;
  const std::int32_t middle = share_of_blocks(count, blocks, half);
  split_at(points, count, middle, longest_side(points, count));
  halve(points, middle, half);
  halve(points + middle, count - middle, blocks - half);
}

}  // namespace

std::int32_t blocks_for(std::int32_t count) { return count / kBlock + (count % kBlock != 0); }

std::int32_t share_of_blocks(std::int32_t count, std::int32_t blocks, std::int32_t block) {
  return static_cast<std::int32_t>(static_cast<std::int64_t>(count) * block / blocks);
}

void order_by_halving(LocalPoint* points, std::int32_t count) { halve(points, count, blocks_for(count)); }

void order_by_fours(LocalPoint* points, std::int32_t count) {
  if (count <= 4) return;
  const std::int32_t middle = (count / 4 + (count % 4 != 0)) / 2 * 4;
  split_at(points, count, middle, longest_side(points, count));
  order_by_fours(points, middle);
  order_by_fours(points + middle, count - middle);
}

}  // namespace dch::detail
