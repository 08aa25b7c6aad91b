// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <vector>

namespace LAMMPS_NS {

class Angle;
class Bond;
class Compute;
class Fix;
class Pair;

/// A style of ours, under the name that scripts give it.
template <class Base, class... Arguments>
struct StyleEntry {
  const char* name;
  Base* (*create)(LAMMPS* lammps, Arguments... arguments);
  /// The same if `dch on` takes it in place of a plain style, which the log says.
  Base* (*create_chosen)(LAMMPS* lammps, Arguments... arguments);
};

/// All that the headers of styles enter by LAMMPS's macros PairStyle, BondStyle, AngleStyle, ComputeStyle
/// and FixStyle.
std::vector<StyleEntry<Pair>> pair_styles_dch();
std::vector<StyleEntry<Bond>> bond_styles_dch();
std::vector<StyleEntry<Angle>> angle_styles_dch();
std::vector<StyleEntry<Compute, int, char**>> compute_styles_dch();
std::vector<StyleEntry<Fix, int, char**>> fix_styles_dch();

/// Makes the styles known to this LAMMPS, if they are not yet.
void register_styles_dch(LAMMPS& lmp);

}  // namespace LAMMPS_NS
