// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>

#include "near_beads.h"

namespace LAMMPS_NS {

/// Whether bonds tell in which images chains go on, as dch::necklace::unwrap() wants it, where no process has
/// all beads of a chain. Each process looks at the bonds between its own beads. The ends of a bond between
/// two processes meet on a third one, which has that chain for a task, and so do the sums of a ring's bonds,
/// which have to be nothing.
class BondCheck : protected Pointers {
 public:
  using Pointers::Pointers;

  /// Collective.
  /// @return false where a bond, or a ring, that this process looks at is not plainly short enough
  bool are_determined(const ChainMap& chains, const NearBeads& beads, const dch::Box& box);

  bigint bytes_sent() const { return bytes_; }

 private:
  bigint bytes_ = 0;
};

}  // namespace LAMMPS_NS
