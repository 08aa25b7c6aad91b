// SPDX-License-Identifier: MIT
//
// What passes over cluster pairs share: numbers by slot, and sums of tasks in their order.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/clusters/cluster_pairs.hpp>
#include <dch/forces/cluster_scratch.hpp>

namespace dch::detail {

/// Clusters that worker `worker` of `workers` prepares.
inline ClusterPairs::Range share(std::int32_t clusters, int worker, int workers) {
  return {share_begin(clusters, worker, workers), share_begin(clusters, worker + 1, workers)};
}

template <class Real>
void add(const ClusterOfFour<Real>& force, ClusterOfFour<Real>& to) {
  for (int slot = 0; slot < ClusterPairs::kSlots; ++slot) {
    to.x[slot] += force.x[slot];
    to.y[slot] += force.y[slot];
    to.z[slot] += force.z[slot];
  }
}

inline void add(const ClusterTallies& found, ClusterTallies& to) {
  for (int n = 0; n < 8; ++n)
    for (int slot = 0; slot < ClusterPairs::kSlots; ++slot) to.number[n][slot] += found.number[n][slot];
}

/// Adds what a task has found for clusters of later tasks to what earlier ones have.
/// @tparam OfCluster  forces or tallies
template <class OfCluster>
void add_for_later(Span<const ClusterPairs::Range> ranges, std::vector<OfCluster>& found,
                   std::vector<OfCluster>& later) {
  for (const ClusterPairs::Range& range : ranges) {
    for (auto c = static_cast<std::size_t>(range.first); c < static_cast<std::size_t>(range.last); ++c) {
      add(found[c], later[c]);
      found[c] = {};
    }
  }
}

/// Numbers of particles, times a unit, by slot; 0 for padding.
template <class FourNumbers>
void sort_by_slot(const ClusterPairs& pairs, Span<const double> numbers, double unit,
                  ClusterPairs::Range clusters, std::vector<FourNumbers>& slots) {
  for (auto c = static_cast<std::size_t>(clusters.first); c < static_cast<std::size_t>(clusters.last); ++c) {
    for (std::size_t slot = 0; slot < ClusterPairs::kSlots; ++slot) {
      const std::int32_t i = pairs.particle[c * ClusterPairs::kSlots + slot];
      auto& number = slots[c].slot[slot];
      number = i < 0
                   ? 0
                   : static_cast<std::decay_t<decltype(number)>>(unit * numbers[static_cast<std::size_t>(i)]);
    }
  }
}

}  // namespace dch::detail
