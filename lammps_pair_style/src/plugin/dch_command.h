// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(dch,DchCommand);
// clang-format on
#elif !defined(LMP_DCH_COMMAND_H)
#define LMP_DCH_COMMAND_H

#include <lammps_host.h>

namespace LAMMPS_NS {

/// The input script command `dch on|off|stats|explain|verify ...`.
class DchCommand : public Command {
 public:
  explicit DchCommand(LAMMPS* lammps) : Command(lammps) {}
  void command(int narg, char** arg) override;
};

}  // namespace LAMMPS_NS

#endif
