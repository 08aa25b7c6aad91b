// SPDX-License-Identifier: MIT
//
// What passes of a generalized Born sum read of pairs and how they sum it up, over vector types; see
// cluster_loops.hpp.
#pragma once

#include "simd/born_task.hpp"
#include "simd/lj_kernels_loops.hpp"

namespace dch::detail {
namespace {

/// Forces and scalars of the pairs of each register: of an entry on its cluster J, or summed up over a row.
template <class S>
struct BornNumbers {
  Coordinates<S> force;
  typename S::V scalar[S::kRegisters];
  BornNumbers() {
    for (int p = 0; p < S::kRegisters; ++p) force.x[p] = force.y[p] = force.z[p] = scalar[p] = S::zero();
  }
};

/// Scalars where a cluster's x is.
template <class S>
Coordinates<S> as_coordinates(const typename S::V* scalar) {
  Coordinates<S> all;
  for (int p = 0; p < S::kRegisters; ++p) {
    all.x[p] = scalar[p];
    all.y[p] = all.z[p] = S::zero();
  }
  return all;
}

template <class S>
void add_to_lane(typename S::V number, float* lanes) {
  S::store(lanes, S::add(S::load(lanes), number));
}

/// Adds the numbers of an entry to its cluster J.
template <class S, bool kForces, bool kScalars>
void give_to_j(const BornTask& task, std::int32_t cluster, const BornNumbers<S>& of) {
  if constexpr (kWantsLanes<S>) {
    float* const lanes = task.lanes + kBornLanes * cluster;
    if constexpr (kForces) {
      add_to_lane<S>(of.force.x[0], lanes);
      add_to_lane<S>(of.force.y[0], lanes + 16);
      add_to_lane<S>(of.force.z[0], lanes + 32);
    }
    if constexpr (kScalars) add_to_lane<S>(of.scalar[0], lanes + 48);
  } else {
    if constexpr (kForces) S::add_over_i(of.force, task.force[cluster]);
    if constexpr (kScalars) S::add_over_i(as_coordinates<S>(of.scalar), task.scalar[cluster]);
  }
}

/// Sums up the lanes of clusters and leaves them 0.
template <class S>
void fold_born_lanes(const BornTask& task, ClusterPairs::Range clusters) {
  if constexpr (kWantsLanes<S>) {
    for (std::int32_t c = clusters.first; c < clusters.last; ++c) {
      float* const lanes = task.lanes + kBornLanes * c;
      Coordinates<S> force;
      force.x[0] = S::load(lanes);
      force.y[0] = S::load(lanes + 16);
      force.z[0] = S::load(lanes + 32);
      S::add_over_i(force, task.force[c]);
      const typename S::V scalar = S::load(lanes + 48);
      S::add_over_i(as_coordinates<S>(&scalar), task.scalar[c]);
      for (int axis = 0; axis < 4; ++axis) S::store(lanes + 16 * axis, S::zero());
    }
  }
}

/// Displacements from I to J, in units, and squared distances.
template <class S>
struct BornApart {
  Coordinates<S> d;
  typename S::V r2[S::kRegisters];
};

template <class S>
BornApart<S> born_apart(const BornTask& task, const ClusterPairs::Row& row, const Places<S>& i,
                        const ClusterPairs::Entry& entry, typename S::V unit2) {
  const auto j = S::load_cluster(task.at[entry.cluster], task.shift[row.first_shift + entry.shift]);
  BornApart<S> found;
  for (int p = 0; p < S::kRegisters; ++p) {
    found.d.x[p] = S::difference(j.x, i.x[p]);
    found.d.y[p] = S::difference(j.y, i.y[p]);
    found.d.z[p] = S::difference(j.z, i.z[p]);
    const typename S::V units2 = S::madd(
        found.d.x[p], found.d.x[p], S::madd(found.d.y[p], found.d.y[p], S::mul(found.d.z[p], found.d.z[p])));
    found.r2[p] = in_length2<S>(units2, unit2);
  }
  return found;
}

/// Whether a pair of register p is at most so far apart.
template <class S>
bool any_within(typename S::V r2, float limit2, std::uint32_t mask, int p) {
  return (S::bits_at_most(r2, S::set1(limit2)) & mask >> (S::kLanes * p)) != 0;
}

/// Adds force / r times displacements to an entry's numbers, and takes them from the row's.
template <class S>
void add_born_force(typename S::V over_r, const Coordinates<S>& d, int p, BornNumbers<S>& of_j,
                    BornNumbers<S>& row) {
  of_j.force.x[p] = S::mul(over_r, d.x[p]);
  of_j.force.y[p] = S::mul(over_r, d.y[p]);
  of_j.force.z[p] = S::mul(over_r, d.z[p]);
  row.force.x[p] = S::add(row.force.x[p], of_j.force.x[p]);
  row.force.y[p] = S::add(row.force.y[p], of_j.force.y[p]);
  row.force.z[p] = S::add(row.force.z[p], of_j.force.z[p]);
}

}  // namespace
}  // namespace dch::detail
