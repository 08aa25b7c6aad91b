// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps.h>

namespace LAMMPS_NS {

/// From now on commands that go through atoms in the order of memory, or number them in it, find them in
/// LAMMPS's order, if that is known: atoms are put back in it before the command begins. Only for commands
/// after which no run can go on with its lists. May be called again.
void restore_order_before_commands(LAMMPS& lammps);

}  // namespace LAMMPS_NS
