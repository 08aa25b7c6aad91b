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

/// Slot a of the cluster for pairs 4 a to 4 a + 3.
template <class S>
Coordinates<S> spread(const ClusterOfFour<typename S::Real>& cluster) {
  Coordinates<S> all;
  for (int p = 0; p < S::kRegisters; ++p) {
    all.x[p] = S::spread(cluster.x, p);
    all.y[p] = S::spread(cluster.y, p);
    all.z[p] = S::spread(cluster.z, p);
  }
  return all;
}

}  // namespace
}  // namespace dch::detail
