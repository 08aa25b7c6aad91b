// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <lammps_host.h>
#include <lmptype.h>
#include <pointers.h>
#include <string>
#include <vector>

#include "dch_options.h"

namespace LAMMPS_NS {

/// Keeps this process's atoms in memory in the order of the structure, in which rows of lists go through
/// their neighbors, where LAMMPS sorts them by bins: as often as `atom_modify sort` says, through
/// Atom::sort().
class AtomOrder : protected Pointers {
 public:
  explicit AtomOrder(LAMMPS* lammps) : Pointers(lammps) {}

  void set_when(dch::lammps::OrderAtoms when) { when_ = when; }
  /// A run begins.
  void begin_run();
  /// Rows of the lists of this run are short, so they are put in the order of atoms, not atoms in that of
  /// rows.
  void note_short_rows();
  /// Lists of this run are of grains, whose contacts would have to follow.
  void note_grains();
  /// Why atoms stay as LAMMPS sorts them in this run; empty if they do not.
  const std::string& obstacle() const { return obstacle_; }
  /// Whether atoms are to be put in order before the next lists are built.
  bool is_due() const;
  /// Puts atoms in the order given, those that it lacks last. To be called where no ghosts are of use until
  /// they are made anew.
  /// @param indices of atoms; what is -1, a ghost or has been there before is passed over
  /// @return by old index the new one; empty if atoms have stayed where they were
  std::vector<int> apply(const std::vector<std::int32_t>& indices);
  /// Puts atoms back in the order in which LAMMPS would have them, if that is known: on one process, unless
  /// atoms have come or gone. Fixes that draw random numbers may come before the next run. To be called as
  /// apply().
  /// @return whether they have been moved
  bool restore();

 private:
  bool can_sort() const;
  void follow_lammps();
  std::vector<int> put(const std::vector<std::int32_t>& indices);

  std::vector<tagint> lammps_order_;  ///< IDs; empty if atoms are in that order, or it is not known
  dch::lammps::OrderAtoms when_ = dch::lammps::OrderAtoms::automatic;
  std::string obstacle_;
  bigint next_ = 0;  ///< step
};

}  // namespace LAMMPS_NS
