// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <atom.h>
#include <lammps_host.h>
#include <vector>

#include <dch/lists/exclusions.hpp>

namespace LAMMPS_NS {

/// What `special_bonds` does to pairs of bonded atoms: those with weights of 0 are in no list, those with
/// others than 0 and 1 are marked in it.
class SpecialPairs : protected Pointers {
 public:
  explicit SpecialPairs(LAMMPS* lammps) : Pointers(lammps) {}

  /// 0: an ordinary pair, 1 to 3: a 1-2, 1-3, 1-4 pair that the pair style has to weight, -1: one that it
  /// never sees.
  int kind(int i, int j) const;
  /// Whether owned atom i has such partners at all.
  bool has_partners(int i) const { return atom->molecular != Atom::ATOMIC && atom->nspecial[i][2] > 0; }
  /// Whether there are pairs to be marked.
  bool any_marked() const;

  /// The pairs of the first `count` owned atoms that are in no list, where one process owns all atoms; null
  /// if there are none. Made anew when atoms were put in another order or their bonds have changed.
  const dch::Exclusions* never_seen(int count);

 private:
  bool are_as_before(int count);

  std::vector<tagint> tags_,
      partners_;           ///< what the exclusions were made from: IDs, and the partners of all atoms
  std::vector<int> ends_;  ///< nspecial of all atoms
  int flags_[4] = {};      ///< from 1, as LAMMPS has them
  dch::Exclusions exclusions_;
};

}  // namespace LAMMPS_NS
