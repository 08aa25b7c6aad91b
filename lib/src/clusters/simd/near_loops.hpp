// SPDX-License-Identifier: MIT
//
// The loops that find boxes and clusters near each other; see cluster_loops.hpp. Without fused operations, so
// that all sets round alike.
#pragma once

#include "clusters/simd/cluster_loops.hpp"
#include "clusters/simd/cluster_search_kernels.hpp"

namespace dch::detail {
namespace {

template <class S>
std::int32_t near_boxes(const BoxArrays& boxes, std::int32_t count, const float* box, float limit2,
                        std::int32_t* chosen) {
  using V = typename S::V;
  V low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = S::set1(box[axis]);
    high[axis] = S::set1(box[axis + 3]);
  }
  const V limit = S::set1(limit2);
  std::int32_t found = 0;
  for (std::int32_t k = 0; k < count; k += S::kLanes) {
    V distance2 = S::zero();
    for (int axis = 0; axis < 3; ++axis) {
      const V gap = S::max(S::max(S::sub(S::load(boxes.side[axis] + k), high[axis]),
                                  S::sub(low[axis], S::load(boxes.side[axis + 3] + k))),
                           S::zero());
      distance2 = S::add(distance2, S::mul(gap, gap));
    }
    std::uint32_t lanes = S::bits_at_most(distance2, limit);
    if (count - k < S::kLanes) lanes &= (1u << (count - k)) - 1;
    found += S::append(lanes, k, chosen + found);
  }
  return found;
}

template <class S>
std::int32_t near_clusters(const ClusterOfFour<float>* clusters, const ClusterOfFour<float>& own,
                           float limit2, std::int32_t* chosen, std::int32_t count) {
  const Coordinates<S> i = spread<S>(own);
  const auto limit = S::set1(limit2);
  std::int32_t kept = 0;
  for (std::int32_t n = 0; n < count; ++n) {
    const auto j = S::load_cluster(clusters[chosen[n]]);
    std::uint32_t near = 0;
    for (int p = 0; p < S::kRegisters; ++p) {
      const auto dx = S::sub(j.x, i.x[p]), dy = S::sub(j.y, i.y[p]), dz = S::sub(j.z, i.z[p]);
      near |= S::bits_at_most(S::add(S::add(S::mul(dx, dx), S::mul(dy, dy)), S::mul(dz, dz)), limit);
    }
    chosen[kept] = chosen[n];
    kept += near != 0;
  }
  return kept;
}

}  // namespace
}  // namespace dch::detail
