// SPDX-License-Identifier: MIT
//
// See cluster_loops.hpp.
#pragma once

#include <cstdint>

#include <dch/base/vec3.hpp>

namespace dch::detail {
namespace {

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

}  // namespace
}  // namespace dch::detail
