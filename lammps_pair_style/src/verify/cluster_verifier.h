// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <lammps_host.h>
#include <string>
#include <vector>

#include "cluster_list.h"
#include "list_compare.h"
#include "list_verifier.h"
#include "pair_rules.h"

namespace LAMMPS_NS {

/// Compares a ClusterList with the native half list of the same pair style, over all processes.
///
/// Within the list radius of their types both have to hold the same pairs, each once: so none is missing or
/// there twice, and none that `neigh_modify exclude` or a weight of 0 leaves out is there. Bonded pairs with
/// other weights have to be among ClusterList::special with the special bits of the native list. The pairs
/// beyond that radius, of which a ClusterList may hold some, are not looked at: they come within the cutoff
/// after the next search only. Displacements are compared too, so a pair with a wrong image is a difference.
class ClusterVerifier : protected Pointers {
 public:
  ClusterVerifier(LAMMPS* lammps, const ListVerifier& verifier, const PairRules& rules)
      : Pointers(lammps), verifier_(verifier), rules_(rules) {}

  struct Result {
    std::string difference;     ///< as ListVerifier::compare()
    std::int64_t compared = 0;  ///< native pairs of this process
  };

  /// Every process has to call it, at the positions that both were made from.
  /// @param native what ListVerifier::entries() says of the list
  /// @param rounding pairs so near their cutoff may be in either [length]
  /// O(pairs lg pairs) time, and memory for all pairs of both.
  Result compare(const std::vector<dch::lammps::ListEntry>& native, const ClusterList& ours,
                 double rounding) const;

 private:
  dch::lammps::AtomPair pair_of(int i, int j, dch::Vec3 from_i_to_j, int special, double rounding) const;
  dch::Vec3 between(int i, int j) const;
  /// Adds a pair to `out` if it is within the list radius of its types.
  void take(const dch::lammps::AtomPair& pair, int i, int j, dch::Vec3 from_i_to_j,
            std::vector<dch::lammps::AtomPair>& out) const;
  void take_native(const std::vector<dch::lammps::ListEntry>& native, bool in_box, double rounding,
                   std::vector<dch::lammps::AtomPair>& out) const;
  void take_ours(const ClusterList& ours, double rounding, std::vector<dch::lammps::AtomPair>& out) const;

  const ListVerifier& verifier_;
  const PairRules& rules_;
};

}  // namespace LAMMPS_NS
