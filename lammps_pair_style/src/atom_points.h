// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <lammps_host.h>
#include <vector>

#include "point_keys.h"

namespace LAMMPS_NS {

/// The atoms of this process as the search sees them: points without a box, since ghosts stand where the
/// images are.
class AtomPoints : protected Pointers {
 public:
  explicit AtomPoints(LAMMPS* lammps) : Pointers(lammps) {}

  /// Takes the owned atoms and ghosts as they are now, with `neigh_modify include` only those of its group.
  void gather();

  dch::Span<const dch::Vec3> positions() const { return positions_; }
  dch::Span<const std::uint64_t> keys() const { return keys_; }   ///< empty if the points have no names
  const std::vector<int>& atoms() const { return atoms_; }        ///< LAMMPS's index of each point, ascending
  dch::Span<const std::int32_t> types() const { return types_; }  ///< from 0
  int owned() const { return owned_; }  ///< the first so many points are owned atoms

 private:
  void select_atoms();

  std::vector<int> atoms_;
  int owned_ = 0;
  std::vector<dch::Vec3> positions_;
  std::vector<std::int32_t> types_;
  std::vector<std::int64_t> tags_;
  std::vector<dch::lammps::ImageFlags> images_;
  dch::lammps::PointKeys key_maker_;
  dch::Span<const std::uint64_t> keys_;
};

}  // namespace LAMMPS_NS
