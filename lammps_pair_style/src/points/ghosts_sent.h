// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <comm.h>
#include <lammps_host.h>

namespace LAMMPS_NS {

/// Which ghosts LAMMPS leaves out, though they are within the cutoff of an atom of the process that would get
/// them: its class says so to its subclasses alone. `comm_modify cutoff` and `cutoff/multi` only add ghosts.
struct GhostsSent : Comm {
  /// `comm_modify mode multi reduce/multi`: a pair of collections with different cutoffs has a ghost on the
  /// side of the smaller atom alone.
  static bool on_one_side(const Comm& comm) {
    return comm.mode == MULTI && comm.*(&GhostsSent::multi_reduce) != 0;
  }
  /// `comm_modify group`: atoms outside of the group have no ghosts at all.
  static bool of_one_group(const Comm& comm) { return comm.*(&GhostsSent::bordergroup) != 0; }
};

}  // namespace LAMMPS_NS
