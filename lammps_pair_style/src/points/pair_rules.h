// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <vector>

#include "ghost_sides.h"

namespace LAMMPS_NS {

/// Which pairs of atoms within the cutoff are left out: those of `neigh_modify exclude`, and with newton on
/// those of an owned atom and a ghost that belong to the other side.
///
/// Exclusions are as they stand when a run begins: LAMMPS's own builders copy these settings then, and a fix
/// that changes them later on does so for the next run.
class PairRules : protected Pointers {
 public:
  PairRules(LAMMPS* lammps, const GhostSides& sides) : Pointers(lammps), sides_(sides) {}

  void copy_settings();
  bool excludes_any() const { return excludes_any_; }
  bool excluded(int i, int j) const;
  /// Whether owned atom i takes the pair with a ghost; the ghost's owner, and what is this atom's ghost
  /// there, take it else.
  bool stored_here(int i, int ghost) const;
  /// Whether the ghost alone decides that: GhostSides::is_taken_here().
  bool goes_by_side() const;
  const GhostSides& sides() const { return sides_; }

 private:
  struct GroupPair {
    int bit1, bit2;
  };
  struct Molecules {
    int bit;
    bool intra;
  };
  const GhostSides& sides_;
  bool excludes_any_ = false;
  int stride_ = 0;
  std::vector<char> types_;  ///< stride_ x stride_, by atom types
  std::vector<GroupPair> groups_;
  std::vector<Molecules> molecules_;
};

}  // namespace LAMMPS_NS
