// SPDX-License-Identifier: MIT
//
// The loops over clusters of four, over vector types `S` for float and double: kLanes values of the 16 pairs
// of a cluster pair, i-major, in kRegisters vectors. Included by one source file for each instruction set,
// which is compiled for that set alone; everything here has internal linkage, so that the linker cannot put
// code of one set in the place of another's. For the same reason nothing of the standard library is used.
#pragma once

#include <cstdint>

#include <dch/clusters/cluster_pairs.hpp>

#include "clusters/simd/few_types.hpp"

namespace dch::detail {
namespace {

template <class S>
struct Coordinates {
  typename S::V x[S::kRegisters], y[S::kRegisters], z[S::kRegisters];
};

/// Coordinates of places as ClusterPlace has them: `Where` are integers in single precision.
template <class S>
struct Places {
  typename S::Where x[S::kRegisters], y[S::kRegisters], z[S::kRegisters];
};

/// Of displacements, and of their squares, in units, those in the unit of length.
template <class S>
typename S::V in_length(typename S::V d, typename S::V unit) {
  if constexpr (std::is_same_v<typename S::Real, float>) return S::mul(d, unit);
  return d;
}
template <class S>
typename S::V in_length2(typename S::V d2, typename S::V unit2) {
  return in_length<S>(d2, unit2);
}

/// Whether rows of one image have one shift: places are integers, not relative to origins.
template <class S>
constexpr bool kShiftsByImage = std::is_same_v<typename S::Real, float>;

/// Cluster I moved against the image of its row, so that no cluster J has to be moved.
template <class S>
void subtract_shift(const ClusterShift<float>& shift, Places<S>& i) {
  for (int p = 0; p < S::kRegisters; ++p) {
    i.x[p] = S::less_shift(i.x[p], shift.axis[0]);
    i.y[p] = S::less_shift(i.y[p], shift.axis[1]);
    i.z[p] = S::less_shift(i.z[p], shift.axis[2]);
  }
}

/// Slot a of the cluster for pairs 4 a to 4 a + 3.
template <class S>
Places<S> spread(const ClusterPlace<typename S::Real>& cluster) {
  Places<S> all;
  for (int p = 0; p < S::kRegisters; ++p) {
    all.x[p] = S::spread(cluster.x, p);
    all.y[p] = S::spread(cluster.y, p);
    all.z[p] = S::spread(cluster.z, p);
  }
  return all;
}

}  // namespace
}  // namespace dch::detail
