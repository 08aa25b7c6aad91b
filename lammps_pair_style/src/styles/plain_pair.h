// SPDX-License-Identifier: GPL-2.0-or-later
// What pair styles of ours do alike beside a plain style, or in place of one.
#pragma once

#include <algorithm>
#include <memory.h>
#include <pair.h>
#include <utility>

namespace LAMMPS_NS {

/// Makes the arrays by pairs of types that LAMMPS looks into, unless they are there.
inline void make_arrays_by_types(Pair& style, int types, Memory& memory) {
  if (std::exchange(style.allocated, 1)) return;
  memory.create(style.setflag, types + 1, types + 1, "pair:setflag");
  memory.create(style.cutsq, types + 1, types + 1, "pair:cutsq");
}

inline void give_up_arrays_by_types(Pair& style, Memory& memory) {
  if (!std::exchange(style.allocated, 0)) return;
  memory.destroy(style.setflag);
  memory.destroy(style.cutsq);
}

/// Says which pairs of types have been given to the plain style, if it has arrays.
inline void take_flags_by_types(const Pair& plain, int types, Memory& memory, Pair& to) {
  if (!plain.allocated) return;
  make_arrays_by_types(to, types, memory);
  for (int a = 1; a <= types; ++a)
    for (int b = a; b <= types; ++b) to.setflag[a][b] = plain.setflag[a][b];
}

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
