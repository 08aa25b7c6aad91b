// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

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

/// Calls act(atoms, count) for the atoms of a group up to `end`, kMostInRun at a time and ascending, wherever
/// they stand.
template <class Act>
void for_batches_of_group(const int* mask, int group_bit, int end, Act act) {
  std::array<int, kMostInRun> atoms;
  int count = 0;
  for (int i = 0; i < end; ++i) {
    atoms[static_cast<std::size_t>(count)] = i;
    if (mask[i] & group_bit) ++count;
    if (count == kMostInRun) {
      act(atoms.data(), count);
      count = 0;
    }
  }
  if (count > 0) act(atoms.data(), count);
}

}  // namespace LAMMPS_NS
