// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <lammps_host.h>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/lists/exclusions.hpp>

namespace LAMMPS_NS {

/// The atoms of a group and the bonds between them, all of them on every process: what belongs to a chain may
/// lie on any. A bead is an atom's rank in ascending order of tags, so that nothing depends on which process
/// has which atom.
///
/// Costs 40 bytes for each atom and 8 for each bond on every process, and time for sorting them.
class GatheredBeads : protected Pointers {
 public:
  using Pointers::Pointers;

  /// Collective.
  /// @param group_bit of the group
  /// @param radius_of_type by type from 1 [length]; empty for the atoms' own radii
  void gather(int group_bit, const std::vector<double>& radius_of_type);

  const std::vector<tagint>& tags() const { return tags_; }    ///< ascending
  const std::vector<double>& radii() const { return radii_; }  ///< [length]
  const std::vector<dch::Vec3>& positions() const { return positions_; }
  /// Those that are not switched off for good (type 0), with both ends in the group.
  const std::vector<dch::IndexPair>& bonds() const { return bonds_; }
  /// The bead that is this atom; -1 if the group has no such atom.
  std::int32_t bead_of(tagint tag) const;

 private:
  void gather_beads(int group_bit, const std::vector<double>& radius_of_type);
  void gather_bonds(int group_bit);

  std::vector<tagint> tags_;
  std::vector<double> radii_;
  std::vector<dch::Vec3> positions_;
  std::vector<dch::IndexPair> bonds_;
};

}  // namespace LAMMPS_NS
