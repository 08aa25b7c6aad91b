// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <vector>

#include "run_report.h"

namespace LAMMPS_NS {

/// Pair, bonded and kspace styles and fixes of the script, each sub-style of a hybrid one by itself: what
/// those of ours say of themselves, and whether there is a style of ours in place of another one, as LAMMPS's
/// tables of styles have it.
std::vector<dch::lammps::StyleNote> style_notes(LAMMPS& lmp);

}  // namespace LAMMPS_NS
