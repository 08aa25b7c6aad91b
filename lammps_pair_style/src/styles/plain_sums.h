// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <pair.h>

namespace LAMMPS_NS {

/// Takes over what a plain pair style has computed, which has been asked for the same.
/// @param atoms that energies and virials by atom are for
inline void take_sums(const Pair& plain, int atoms, Pair& to) {
  to.eng_vdwl = plain.eng_vdwl;
  to.eng_coul = plain.eng_coul;
  std::copy_n(plain.virial, 6, to.virial);
  if (to.eflag_atom) std::copy_n(plain.eatom, atoms, to.eatom);
  if (to.vflag_atom)
    for (int i = 0; i < atoms; ++i) std::copy_n(plain.vatom[i], 6, to.vatom[i]);
  if (to.cvflag_atom && plain.cvatom)
    for (int i = 0; i < atoms; ++i) std::copy_n(plain.cvatom[i], 9, to.cvatom[i]);
}

}  // namespace LAMMPS_NS
