// SPDX-License-Identifier: GPL-2.0-or-later
// What the last lists cost, as a count: weights for LAMMPS's balance.
#include <algorithm>
#include <array>
#include <atom.h>
#include <bitset>
#include <force.h>
#include <lmptype.h>
#include <neigh_list.h>

#include "neighbor_dch.h"

namespace LAMMPS_NS {
namespace {

/// Half of a pair's work to each of its atoms: which of them holds the pair says nothing of where the work
/// is, and which of two processes computes it changes as soon as atoms go from one to the other.
void share_pair(int i, int j, int sharers, double* work) {
  if (i < sharers && j < sharers) {
    work[i] += 0.5;
    work[j] += 0.5;
  } else {
    work[std::min(i, j)] += 1;  // owned atoms come before ghosts
  }
}

/// Builders of copies and of parts take lists of either kind.
const NeighList& origin(const NeighList& list) {
  if (list.listfull) return list;
  if (list.listcopy) return origin(*list.listcopy);
  return list.listskip ? origin(*list.listskip) : list;
}

void add_rows(const NeighList& list, bool full, int sharers, double* work) {
  for (int k = 0; k < list.inum; ++k) {
    const int i = list.ilist[k], n = list.numneigh[i];
    if (full) work[i] += n;
    for (int m = 0; m < n && !full; ++m) share_pair(i, list.firstneigh[i][m] & NEIGHMASK, sharers, work);
  }
}

/// Pairs of slots of each entry, shared evenly among the atoms of its clusters.
void add_clusters(const dch::ClusterPairs& pairs, int sharers, double* work) {
  constexpr int kSlots = dch::ClusterPairs::kSlots;
  std::array<std::int32_t, 2 * std::size_t{kSlots}> atoms{};
  for (std::size_t r = 0; r + 1 < pairs.rows.size(); ++r) {
    const std::int32_t row = pairs.rows[r].cluster;
    for (std::int64_t k = pairs.rows[r].first; k < pairs.rows[r + 1].first; ++k) {
      const dch::ClusterPairs::Entry& entry = pairs.entries[static_cast<std::size_t>(k)];
      std::size_t count = 0;
      const auto take = [&](std::int32_t cluster) {
        for (int slot = 0; slot < kSlots; ++slot) {
          const std::int32_t i = pairs.particle[static_cast<std::size_t>(kSlots * cluster + slot)];
          if (i >= 0 && i < sharers) atoms[count++] = i;
        }
      };
      take(row);
      if (entry.cluster != row) take(entry.cluster);
      const double share =
          static_cast<double>(std::bitset<16>(entry.mask).count()) / static_cast<double>(count);
      for (std::size_t n = 0; n < count; ++n) work[atoms[n]] += share;
    }
  }
}

}  // namespace

void NeighborDCH::count_work(double* work) const {
  const int owned = atom->nlocal, all = atom->nlocal + atom->nghost;
  const int sharers = force->newton_pair ? all : owned;
  for (const ServedClusters& clusters : clusters_) {
    if (!clusters.list->one_by_one) {
      add_clusters(clusters.list->pairs, sharers, work);
      continue;
    }
    const dch::PairList& pairs = clusters.list->pair_list;
    for (std::size_t k = 0; k < pairs.i.size(); ++k) share_pair(pairs.i[k], pairs.j[k], sharers, work);
  }
  for (int m = 0; m < nlist; ++m) {
    const NeighList& list = *lists[m];
    const bool is_for_verify = !clusters_.empty() && !is_needed(m);
    if (list.requestor_type != NeighList::PAIR || list.occasional || is_for_verify) continue;
    const NeighList& made = origin(list);
    const int mask = pairmasks[made.pair_method - 1];
    const bool full = !made.listfull && (mask & NeighConst::NP_FULL) != 0;
    add_rows(list, full, mask & NeighConst::NP_NEWTOFF ? owned : all, work);
  }
}

}  // namespace LAMMPS_NS
