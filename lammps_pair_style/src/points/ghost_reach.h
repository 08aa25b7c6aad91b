// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <vector>

#include <dch/base/vec3.hpp>

namespace LAMMPS_NS {

/// Which ghosts may be in a pair at all, where cutoffs differ by type. LAMMPS makes ghosts as far as the
/// largest cutoff of all types goes, but of most pairs of types it is a smaller one that counts, and a
/// process may have few atoms of the type with the largest, or none.
class GhostReach : protected Pointers {
 public:
  explicit GhostReach(LAMMPS* lammps) : Pointers(lammps) {}

  /// Takes the boxes around the owned atoms of each type, and the cutoffs by types. O(owned atoms).
  void gather();
  /// Whether a ghost is within its cutoff of the box around the owned atoms of some type.
  bool is_within(int ghost) const;

 private:
  struct Around {
    int type;
    dch::Vec3 low, high;
  };
  std::vector<Around> around_;  ///< of types that owned atoms have
};

}  // namespace LAMMPS_NS
