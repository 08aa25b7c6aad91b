// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <lmptype.h>
#include <pointers.h>
#include <vector>

#include "tag_table.h"

namespace LAMMPS_NS {

/// Keeps this process's atoms in memory in the order of the structure, in which rows of lists go through
/// their neighbors, where LAMMPS sorts them by bins: as often as `atom_modify sort` says, through
/// Atom::sort().
class AtomOrder : protected Pointers {
 public:
  explicit AtomOrder(LAMMPS* lammps) : Pointers(lammps) {}

  /// A run begins: the next chance is taken.
  void begin_run() { next_ = 0; }
  /// Whether atoms are to be put in order before the next lists.
  bool is_due() const;
  /// Whether the order of the present lists may be wanted for that.
  bool will_be_due() const;
  /// Takes the order for the next time.
  /// @param indices of atoms, some more than once or ghosts, which do not count again; -1 is passed over
  void remember(const std::vector<std::int32_t>& indices);
  /// Puts atoms in that order; those that have come since go last. Where LAMMPS expects it to sort: no ghosts
  /// are of use until they are made anew. Atom::sort() has to have room for one atom more, else atoms stay as
  /// they are.
  void apply();

 private:
  std::vector<tagint> tags_;  ///< in order
  std::vector<char> seen_;
  bigint next_ = 0;  ///< step
};

}  // namespace LAMMPS_NS
