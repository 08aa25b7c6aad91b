// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <lammps_host.h>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/lists/list_params.hpp>

#include "tag_table.h"

namespace LAMMPS_NS {

/// Which image of an atom is the neighbor of another one, where one process owns all atoms: the atom itself,
/// or one of its ghosts.
class GhostImages : protected Pointers {
 public:
  explicit GhostImages(LAMMPS* lammps) : Pointers(lammps) {}

  /// Takes the ghosts as they are now, for pairs within `radius`. O(owned atoms + ghosts).
  void gather(double radius);
  /// Whether the neighbor cutoff of a pair is the sum of the radii and the skin, else that of the types.
  void set_cutoffs(bool by_radius);

  /// The image of owned atom j that is within the neighbor cutoff of owned atom i, by the positions that
  /// LAMMPS gave the ghosts; -1 if there is none. At most one is, since the radius is less than half the box.
  int within_cutoff(int i, int j) const {
    const double limit = has_one_limit_ ? limit_ : limit_of(i, j);
    return distance2(i, j) <= limit ? j : ghost_within(i, j, limit);
  }

  /// Whether all atoms within the radius of owned atom i are near it themselves, not by a ghost.
  bool is_inside(int i) const { return is_inside(is_skewed_ ? lamda(i) : positions_[i]); }

  /// How far a distance to a ghost, up to `radius`, may be from that to the nearest image in the box, by
  /// rounding [length].
  double error_within(double radius) const;
  double error() const { return error_; }  ///< at the last gather() [length]

 private:
  bool is_inside(dch::Vec3 at) const {
    return at.x >= low_.x && at.x <= high_.x && at.y >= low_.y && at.y <= high_.y && at.z >= low_.z &&
           at.z <= high_.z;
  }
  dch::Vec3 lamda(int i) const;
  double distance2(int i, int j) const {
    const dch::Vec3 d = positions_[i] - positions_[j];
    return norm2(d);
  }
  void set_inside(double reach);
  double limit_of(int i, int j) const;
  int ghost_within(int i, int j, double limit) const;
  void list_ghosts();

  const dch::Vec3* positions_ = nullptr;  ///< LAMMPS's own
  bool has_one_limit_ = false, by_radius_ = false;
  double limit_ = 0;  ///< squared cutoff of all pairs, if they have one [length^2]
  double error_ = 0;
  bool is_skewed_ = false;
  dch::Vec3 low_, high_;    ///< of the atoms inside, in the coordinates of the box if it is triclinic
  std::vector<int> owner_;  ///< by ghost
  std::vector<int> first_,
      ghost_;                 ///< ghosts of owned atom j: ghost_[first_[j]] .. ghost_[first_[j + 1] - 1]
  std::vector<tagint> tags_;  ///< of the owned atoms in the table
  dch::lammps::TagTable by_tag_;
};

/// Has LAMMPS's own positions decide about pairs near the cutoff.
class ImageTest : public dch::TieBreaker {
 public:
  explicit ImageTest(const GhostImages& images) : TieBreaker(images.error()), images_(images) {}
  bool accepts(std::int32_t i, std::int32_t j) const override { return images_.within_cutoff(i, j) >= 0; }

 private:
  const GhostImages& images_;
};

}  // namespace LAMMPS_NS
