// SPDX-License-Identifier: MIT
//
// The loops over clusters of four, over vector types `S` for float and double: kLanes values of the 16 pairs
// of a cluster pair, i-major, in kParts vectors. Included by one source file for each instruction set, which
// is compiled for that set alone; everything here has internal linkage, so that the linker cannot put code of
// one set in the place of another's. For the same reason nothing of the standard library is used.
#pragma once

#include "cluster_kernels.hpp"

namespace dch::detail {
namespace {

template <class S>
struct Coordinates {
  typename S::V x[S::kParts], y[S::kParts], z[S::kParts];
};

/// Slot a of the cluster for pairs 4 a to 4 a + 3.
template <class S>
Coordinates<S> spread(const ClusterOfFour<typename S::Real>& cluster) {
  Coordinates<S> all;
  for (int p = 0; p < S::kParts; ++p) {
    all.x[p] = S::spread(cluster.x, p);
    all.y[p] = S::spread(cluster.y, p);
    all.z[p] = S::spread(cluster.z, p);
  }
  return all;
}

/// Adds forces of pairs, those of `lanes` alone: to particle j[k] what the vectors have in lane k, to i[k]
/// the opposite. One lane after the other, since a particle may stand in several.
template <class S>
void add_to_both(std::uint32_t lanes, const std::int32_t* i, const std::int32_t* j, typename S::V fx,
                 typename S::V fy, typename S::V fz, Vec3* forces) {
  alignas(64) typename S::Real x[S::kLanes], y[S::kLanes], z[S::kLanes];
  S::store(x, fx);
  S::store(y, fy);
  S::store(z, fz);
  for (; lanes != 0; lanes &= lanes - 1) {
    const int k = __builtin_ctz(lanes);
    Vec3 &of_i = forces[i[k]], &of_j = forces[j[k]];
    of_i.x -= x[k];
    of_i.y -= y[k];
    of_i.z -= z[k];
    of_j.x += x[k];
    of_j.y += y[k];
    of_j.z += z[k];
  }
}

/// Writes first + lane for each bit that is set. Returns how many.
[[maybe_unused]] inline std::int32_t append_lanes(std::uint32_t lanes, std::int32_t first, std::int32_t* to) {
  std::int32_t written = 0;
  for (; lanes != 0; lanes &= lanes - 1) to[written++] = first + __builtin_ctz(lanes);
  return written;
}

// --- search: without fused operations, so that all sets round alike

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
    for (int p = 0; p < S::kParts; ++p) {
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
