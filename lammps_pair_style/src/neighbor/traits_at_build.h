// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <vector>

namespace LAMMPS_NS {

/// What the pairs of lists depend on beside where atoms are, as it was at the last build: cutoffs, exclusions
/// and the styles of `pair_style hybrid` go by types, exclusions by groups and molecules too, contacts by
/// radii. Once one of these has changed, by a fix or between two runs, no pair counts as listed.
///
/// Ghosts need no look: the process that owns the atom has it.
class TraitsAtBuild : protected Pointers {
 public:
  explicit TraitsAtBuild(LAMMPS* lammps) : Pointers(lammps) {}

  /// @param by_radii whether there are lists whose cutoffs are sums of radii
  void remember(bool by_radii);
  /// Those of this process's atoms.
  bool have_changed() const;

 private:
  bool go_by_types() const;
  int groups_in_use() const;

  int atoms_ = 0;
  int groups_ = 0;  ///< bits of masks that count
  // By owned atom; empty where lists do not go by them.
  std::vector<int> types_, masks_;
  std::vector<tagint> molecules_;
  std::vector<double> radii_;
};

}  // namespace LAMMPS_NS
