// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <atom.h>
#include <lammps_host.h>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#include "atom_pasts.h"
#include "box_step.h"

namespace LAMMPS_NS {

/// Where owned and ghost atoms of this process were at the last check and where they are now, and the bonds
/// that each of them holds. Ghosts get theirs from their owners, by a forward communication of the fix:
/// LAMMPS keeps neither for them. Their present positions are sent too, since a fix that changes the box at
/// the end of a step (fix deform) moves owned atoms alone.
class MovingAtoms : protected Pointers {
 public:
  MovingAtoms(LAMMPS* lammps, AtomPasts& pasts) : Pointers(lammps), pasts_(pasts) {}

  /// Expresses the pasts of owned atoms by the images in which the atoms are now. A past that is half the box
  /// or more away, or that there is not, becomes NaN.
  void begin(const dch::lammps::BoxStep& step, int group_bit);
  /// Makes room for what ghosts get; without it atoms have owned atoms alone.
  /// @param bonds that an atom holds at most
  void expect_ghosts(int bonds);
  /// Makes the present the past.
  void finish();

  bool has_ghosts() const { return width_ > 0; }

  /// The numbers of an atom that pack() writes.
  int numbers() const { return 6 + width_; }
  int pack(int n, const int* list, double* to, bool through_faces, const int* faces) const;
  void unpack(int n, int first, const double* from);

  bool in_group(int i) const { return (atom->mask[i] & group_bit_) != 0; }
  dch::Vec3 before(int i) const { return i < atom->nlocal ? pasts_.position(i) : ghost(i).before; }
  dch::Vec3 now(int i) const {
    if (i >= atom->nlocal) return ghost(i).now;
    const double* const x = atom->x[i];
    return {x[0], x[1], x[2]};
  }

  /// Calls use(partner, whether the bond was there at the last check) for the bonds that an owned atom holds:
  /// each bond of the group is held by one atom.
  template <class Use>
  void for_bonds_of_owned(int i, const Use& use) const {
    if (!in_group(i)) return;
    for (int m = 0; m < atom->num_bond[i]; ++m) {
      const tagint partner = atom->bond_atom[i][m];
      if (is_bond(atom->bond_type[i][m]) && (!both_hold_ || partner > atom->tag[i]))
        use(partner, pasts_.had_bond(i, partner));
    }
  }
  template <class Use>
  void for_bonds_of_ghost(int i, const Use& use) const {
    const tagint* const held = bonds_.data() + place(i) * static_cast<std::size_t>(width_);
    for (int m = 0; m < width_ && held[m] != 0; ++m) use(held[m] < 0 ? -held[m] : held[m], held[m] > 0);
  }
  /// About how many bonds owned atoms and ghosts hold.
  std::size_t bonds_held() const;
  /// Of the bonds that owned atoms hold, the largest number of one atom.
  int most_bonds() const;

  double memory_bytes() const;

 private:
  struct Ghost {
    dch::Vec3 before, now;
  };
  /// Type 0 is a bond that has broken. A negative type is one that is switched off (delete_bonds), unless
  /// fix shake or rattle holds it.
  bool is_bond(int type) const { return type > 0 || (type < 0 && held_by_fix_); }
  std::size_t place(int i) const { return static_cast<std::size_t>(i - atom->nlocal); }
  const Ghost& ghost(int i) const { return ghosts_[place(i)]; }

  AtomPasts& pasts_;
  dch::lammps::BoxStep step_;
  int group_bit_ = 0;
  bool held_by_fix_ = false, both_hold_ = false;
  std::vector<Ghost> ghosts_;
  std::vector<tagint> bonds_;  ///< held by ghosts, width_ for each; 0 for none, negative for a new one
  int width_ = 0;
};

}  // namespace LAMMPS_NS
