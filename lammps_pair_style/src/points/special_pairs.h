// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <atom.h>
#include <cstddef>
#include <cstdint>
#include <lammps_host.h>
#include <vector>

#include <dch/lists/exclusions.hpp>

namespace LAMMPS_NS {

/// The atom with this ID, owned or a ghost, from which `sametag` leads to its other images; -1 if this
/// process has none. LAMMPS's own map goes on to name atoms that were deleted, where no higher IDs are left.
inline int atom_with(Atom& atom, tagint id) {
  const int i = atom.map(id);
  return i >= 0 && i < atom.nlocal + atom.nghost && atom.tag[i] == id ? i : -1;
}

/// What `special_bonds` does to pairs of bonded atoms: those with weights of 0 are in no list, those with
/// others than 0 and 1 are marked in it.
class SpecialPairs : protected Pointers {
 public:
  explicit SpecialPairs(LAMMPS* lammps) : Pointers(lammps) {}

  /// What the bonds of atoms say of their neighbors, wherever the images of these are: right if
  /// are_near_ones().
  class Marks {
   public:
    static constexpr int kInNoList = -1;
    /// Whether there are any.
    bool any() const { return !partner_.empty(); }
    /// Bits of a list's entry of owned atom i for the atom with this ID: 0 of an ordinary neighbor. Only if
    /// any().
    int of(int i, tagint tag) const {
      int mark = 0;  // the last that fits: partners stand in reverse, and the nearest kind of pair counts
      const Partner* const last = partner_.data() + first_[static_cast<std::size_t>(i) + 1];
      for (const Partner* k = partner_.data() + first_[static_cast<std::size_t>(i)]; k != last; k += kAtOnce)
        for (int own = 0; own < kAtOnce; ++own) mark ^= (mark ^ k[own].mark) & -(k[own].tag == tag ? 1 : 0);
      return mark;
    }

   private:
    friend class SpecialPairs;
    struct Partner {
      tagint tag = 0;  ///< no atom's
      int mark = 0;
    };
    static constexpr int kAtOnce = 2;  ///< the bonds of a bead in a chain: no branch that goes now so, now so
    std::vector<std::int32_t> first_;  ///< by owned atom; and one more, for the end of the last
    std::vector<Partner>
        partner_;  ///< those alone that are marked, or in no list; of each atom a multiple of kAtOnce
  };

  /// 0: an ordinary pair, 1 to 3: a 1-2, 1-3, 1-4 pair that the pair style has to weight, -1: one that it
  /// never sees.
  int kind(int i, int j) const;
  /// Whether owned atom i has such partners at all.
  bool has_partners(int i) const { return atom->molecular != Atom::ATOMIC && atom->nspecial[i][2] > 0; }
  /// The marks of all owned atoms, with the weights that `special_bonds` gives now, side by side: rows of
  /// pairs are not in the order of atoms. Good until atoms move in memory. O(atoms).
  const Marks& take_marks();
  /// Whether no neighbor is a far image of a bonded atom, which is no bonded atom in LAMMPS's lists.
  bool are_near_ones() const;
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
  Marks marks_;
  dch::Exclusions exclusions_;
};

}  // namespace LAMMPS_NS
