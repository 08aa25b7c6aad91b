// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <lammps_host.h>
#include <vector>

#include <dch/geometry/box.hpp>

#include "ghost_reach.h"
#include "ghost_sides.h"
#include "point_keys.h"

namespace LAMMPS_NS {

class Domain;

/// LAMMPS's box as the search sees it.
/// @throws dch::InvalidBox
dch::Box box_of(const Domain& domain);

/// Ghosts that are points in open space.
struct GhostChoice {
  const GhostSides* sides =
      nullptr;  ///< those alone whose pairs are taken here; null: those of others as well
  const GhostReach* reach = nullptr;  ///< those alone that may be in a pair; null: all
};

/// The atoms of this process as the search sees them: either its own atoms in the periodic box, where it has
/// that box to itself, or its own atoms and ghosts in open space, since ghosts stand where the images are.
class AtomPoints : protected Pointers {
 public:
  explicit AtomPoints(LAMMPS* lammps) : Pointers(lammps) {}

  /// Whether the own atoms in the box are enough for pairs within `radius`: there is one process, only the
  /// nearest image of an atom can be that near, and LAMMPS has a ghost for whichever of the two atoms of a
  /// pair through a face is looked at from the other.
  bool may_use_box(double radius) const;

  /// Takes the atoms as they are now, with `neigh_modify include` only those of its group. Positions are not
  /// copied unless some are left out, so they have to stay where they are while the points are used.
  void gather(bool in_box, const GhostChoice& choice);

  bool in_box() const { return in_box_; }
  dch::Box box() const;  ///< none in open space
  dch::Span<const dch::Vec3> positions() const { return positions_; }
  /// Where the same points are by now: ghosts are where LAMMPS has last sent them.
  dch::Span<const dch::Vec3> present_positions();
  dch::Span<const std::uint64_t> keys() const { return keys_; }  ///< empty if the points have no names
  /// Gives their memory back, once the search has taken them. keys() is empty from then on.
  void forget_keys();
  dch::Span<const std::int32_t> types();  ///< from 0
  dch::Span<const double> radii();        ///< of spheres [length]
  int size() const { return static_cast<int>(positions_.size()); }
  int owned() const { return owned_; }  ///< the first so many points are owned atoms
  /// Ghosts that the choice has left out; LAMMPS's indices, ascending.
  dch::Span<const int> ghosts_left_out() const { return left_out_; }
  /// Whether ghosts are among the points whose pairs other processes take, and ghosts that are in none.
  bool has_ghosts_of_others() const { return !in_box_ && has_ghosts_of_others_; }
  bool has_far_ghosts() const { return !in_box_ && has_far_ghosts_; }
  /// Whether all atoms, or in the box all owned ones, are points with the same indices.
  bool are_atoms() const { return are_atoms_; }
  /// The point that an atom is; -1 if it is none. O(log points), and of owned atoms O(1).
  std::int32_t point_of(int i) const;
  /// LAMMPS's index of a point.
  int atom_of(std::int32_t point) const {
    return are_atoms_ ? point : atoms_[static_cast<std::size_t>(point)];
  }

 private:
  bool is_flat() const;
  void select_atoms(const GhostChoice& choice);
  void take_positions();
  void name_in_box();
  void name_in_open_space();

  bool in_box_ = false;
  std::vector<int> atoms_;  ///< by point, ascending; empty where are_atoms_
  std::vector<int> left_out_;
  bool are_atoms_ = true, has_ghosts_of_others_ = true, has_far_ghosts_ = true;
  int owned_ = 0, count_ = 0;
  std::vector<dch::Vec3> gathered_;
  dch::Span<const dch::Vec3> positions_;
  std::vector<std::int32_t> types_;
  std::vector<double> radii_;
  std::vector<std::int64_t> tags_;
  std::vector<std::uint64_t> own_keys_;
  std::vector<dch::lammps::ImageFlags> images_;
  dch::lammps::PointKeys key_maker_;
  dch::Span<const std::uint64_t> keys_;
};

}  // namespace LAMMPS_NS
