// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <fix.h>
#include <lammps_host.h>

namespace LAMMPS_NS {

/// The place in LAMMPS's step where atoms may be put in another order: after it has decided to build lists,
/// before atoms go to their processes and ghosts are made. Not for input scripts; NeighborDCH makes one.
class FixDCHOrder : public Fix {
 public:
  static constexpr const char* kStyle = "DCH_ORDER";

  FixDCHOrder(LAMMPS* lammps, int narg, char** arg) : Fix(lammps, narg, arg) {}

  /// Its number in Modify::fix; -1 if there is none.
  static int index_in(const Modify& modify);
  /// Makes one unless there is one, so that the run that is being initialized calls it. Every process has to
  /// call this, after Modify::init().
  static void install(LAMMPS* lammps);

  int setmask() override;
  void setup_pre_exchange() override;
  void pre_exchange() override;
  void min_pre_exchange() override { pre_exchange(); }
};

}  // namespace LAMMPS_NS
