// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>

namespace LAMMPS_NS {

inline constexpr int kMostInRun = 128;  ///< atoms, whose numbers stay in the nearest cache

/// Calls act(first, count) for the runs of atoms of a group, kMostInRun at most, that stand behind each other
/// in memory from `begin` up to `end`.
template <class Act>
void for_runs_of_group(const int* mask, int group_bit, int begin, int end, Act act) {
  for (int i = begin; i < end;) {
    const int first = i, most = std::min(end, first + kMostInRun);
    while (i < most && (mask[i] & group_bit)) ++i;
    if (i > first) act(first, i - first);
    if (i < most) ++i;  // not of the group
  }
}

}  // namespace LAMMPS_NS
