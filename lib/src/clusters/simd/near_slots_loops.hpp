// SPDX-License-Identifier: MIT
//
// The loop that finds which slots of entries are near; see cluster_loops.hpp.
#pragma once

#include "clusters/simd/cluster_loops.hpp"
#include "clusters/simd/cluster_search_kernels.hpp"

namespace dch::detail {
namespace {

/// See ClusterSearchKernels::near_slots.
template <class S>
void near_slots(const NearSlotsTask& task, const ClusterPairs::Row& row, std::int32_t count,
                std::uint16_t* near) {
  const Places<S> i = spread<S>(task.at[row.cluster]);
  const typename S::V limit2 = S::set1(task.limit2);
  for (std::int32_t n = 0; n < count; ++n) {
    const ClusterPairs::Entry& entry = task.entries[row.first + n];
    const auto j = S::load_cluster(task.at[entry.cluster], task.shift[row.first_shift + entry.shift]);
    std::uint32_t bits = 0;
    for (int p = 0; p < S::kRegisters; ++p) {
      const auto dx = S::difference(j.x, i.x[p]), dy = S::difference(j.y, i.y[p]),
                 dz = S::difference(j.z, i.z[p]);
      const auto units2 = S::madd(dx, dx, S::madd(dy, dy, S::mul(dz, dz)));
      bits |= S::bits_at_most(units2, limit2) << (S::kLanes * p);
    }
    near[n] = static_cast<std::uint16_t>(bits);
  }
}

}  // namespace
}  // namespace dch::detail
