// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

// What differs between the header sets that LAMMPS's versions install.
#include <lammps.h>
#include <pointers.h>

#if __has_include(<command.h>)
#include <command.h>
#else
namespace LAMMPS_NS {

/// LAMMPS's own base of input script commands, which the 2021 packages do not install: the virtual functions,
/// in this order, are what Input calls.
class Command : protected Pointers {
 public:
  explicit Command(LAMMPS* lammps) : Pointers(lammps) {}
  virtual void command(int narg, char** arg) = 0;
};

}  // namespace LAMMPS_NS
#endif
