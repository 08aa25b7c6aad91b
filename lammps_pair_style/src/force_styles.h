// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <vector>

namespace LAMMPS_NS {

class Bond;
class Pair;

/// A style with the suffix dch, under the name that scripts give it.
template <class Base>
struct ForceStyle {
  const char* name;
  Base* (*create)(LAMMPS* lammps);
};

/// All that the headers of styles enter by LAMMPS's macros PairStyle and BondStyle.
std::vector<ForceStyle<Pair>> pair_styles_dch();
std::vector<ForceStyle<Bond>> bond_styles_dch();

/// Makes the styles known to this LAMMPS, if they are not yet.
void register_styles_dch(LAMMPS& lmp);

}  // namespace LAMMPS_NS
