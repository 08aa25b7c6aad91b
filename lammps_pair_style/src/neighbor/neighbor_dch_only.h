// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "neighbor_dch.h"

namespace LAMMPS_NS {

/// Restricts what Neighbor::build() builds to some of the perpetual lists while it lives.
class NeighborDCH::OnlyTheseLists {
 public:
  OnlyTheseLists(NeighborDCH& neighbor, std::vector<int>& lists)
      : neighbor_(neighbor),
        plist_(std::exchange(neighbor.plist, lists.data())),
        npair_(std::exchange(neighbor.npair_perpetual, static_cast<int>(lists.size()))) {}
  ~OnlyTheseLists() {
    neighbor_.plist = plist_;
    neighbor_.npair_perpetual = npair_;
  }
  OnlyTheseLists(const OnlyTheseLists&) = delete;
  OnlyTheseLists& operator=(const OnlyTheseLists&) = delete;

 private:
  NeighborDCH& neighbor_;
  int* plist_;
  int npair_;
};

}  // namespace LAMMPS_NS
