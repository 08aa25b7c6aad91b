// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>

namespace LAMMPS_NS {

/// Makes the names of plain styles stand for those of ours from now on, and of pair styles that have none for
/// those of LAMMPS's package OPT; or for themselves again. The tables of styles keep the plain ones as
/// dch::lammps::kStock says. Names stay the script's, in restart files too; styles that are there already
/// stay what they are.
void choose_styles(LAMMPS& lmp, bool ours);

}  // namespace LAMMPS_NS
