// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>

namespace LAMMPS_NS {

/// The input script command `dch on|off|stats|verify ...`.
class DchCommand : public Command {
 public:
  explicit DchCommand(LAMMPS* lammps) : Command(lammps) {}
  void command(int narg, char** arg) override;
};

}  // namespace LAMMPS_NS
