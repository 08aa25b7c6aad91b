// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <lammps_host.h>
#include <vector>

#include <dch/necklace/necklace.hpp>

#include "bead_messages.h"

namespace LAMMPS_NS {

/// Which atoms of a group make which chains, on every process, though not where they are: how many bonds lie
/// between two beads no process can tell from its own atoms. Gathered when atoms or bonds of the group are
/// others than before, which each process sees in its own; until then nothing is.
///
/// A bead is an atom's rank in ascending order of tags, so that nothing depends on which process has which
/// atom. Costs 4 bytes for each atom and 8 for each bond on every process when they are sent, and about 30
/// for each atom to keep.
class ChainMap : protected Pointers {
 public:
  using Pointers::Pointers;

  /// Collective.
  /// @return whether chains are others than before
  /// @throws dch::InvalidParameter for bonds that make no chains, on all processes
  bool follow(int group_bit);

  const std::vector<tagint>& tags() const { return tags_; }  ///< ascending
  /// With radii that mean nothing.
  const dch::necklace::Necklace& chains() const { return chains_; }
  /// The bead that is this atom; -1 if the group has no such atom.
  std::int32_t bead_of(tagint tag) const;
  std::int32_t place_of(std::int32_t bead) const { return place_[static_cast<std::size_t>(bead)]; }
  /// What the last follow() sent.
  bigint bytes_sent() const { return bytes_; }

 private:
  bool are_as_before(int group_bit) const;
  std::vector<dch::IndexPair> gather_bonds(int group_bit);

  bool known_ = false;
  std::vector<tagint> tags_;
  dch::necklace::Necklace chains_;
  std::vector<std::int32_t> place_;  ///< by bead; -1 for none
  bigint bond_count_ = 0, bytes_ = 0;
};

}  // namespace LAMMPS_NS
