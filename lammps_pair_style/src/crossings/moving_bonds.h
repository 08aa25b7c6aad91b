// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <lammps_host.h>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/necklace/bond_encounter.hpp>

#include "moving_atoms.h"

namespace LAMMPS_NS {

/// The bonds that a process sees: first those that its own atoms hold, then those of its ghosts, each with
/// the image of the second atom that is nearest to the first. Bonds that were not there at the last check are
/// left out, and so are those whose motion is not known, which are counted.
class MovingBonds : protected Pointers {
 public:
  using Pointers::Pointers;

  struct Limits {
    bool in_box =
        false;  ///< whether second atoms are owned ones in the periodic box, or ghosts where they stand
    double length = 0;  ///< bonds are shorter than this, half the height of the box [length]
    double extent = 0;  ///< length and displacement of a bond together are at most this [length]
  };

  /// A bond about the middle of its motion, which is taken against the lattice: a point of it is middle + s
  /// half_bond + t half_move + s t quarter_turn, s and t from -1 to 1.
  struct Shape {
    std::array<float, 3> half_bond, half_move, quarter_turn;
  };

  void gather(const MovingAtoms& atoms, const dch::lammps::BoxStep& step, const Limits& limits);

  std::size_t size() const { return ends_.size(); }
  std::size_t owned() const { return owned_; }
  bigint undetermined() const { return undetermined_; }
  double largest_extent() const { return largest_extent_; }  ///< of all, also of those left out [length]
  /// By how much a changing box may take two bonds farther apart, as a factor.
  double stretch() const { return stretch_; }
  const dch::lammps::BoxStep& step() const { return step_; }
  /// Of balls about the middles that hold the bonds at all times [length].
  double radius() const { return radius_; }
  dch::Span<const dch::Vec3> middles() const { return middles_; }
  /// Of the ball of one bond.
  double radius(std::size_t bond) const { return static_cast<double>(radii_[bond]); }
  /// Made anew from where the atoms were and are: few bonds are asked for it.
  Shape shape(std::size_t bond) const;
  /// Whether they have a common atom, as the same image.
  bool share_an_end(std::size_t a, std::size_t b) const {
    const auto &p = ends_[a], &q = ends_[b];
    return p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1];
  }
  /// IDs of the atoms, ascending.
  std::array<tagint, 2> tags(std::size_t bond) const;
  /// From the atom of smaller ID to the other. `shift` counts vectors of the box by which the bond is moved.
  dch::necklace::MovingBond path(std::size_t bond, dch::Vec3 shift = {}) const;

  double memory_bytes() const;

 private:
  void clear(std::size_t expected);
  /// The displacements of both ends, against the lattice at the middle.
  std::array<dch::Vec3, 2> moves(const dch::necklace::MovingBond& path, dch::Vec3 middle) const;
  void add(int i, int j, bool is_owned);
  dch::necklace::MovingBond path_of(int i, int j) const;

  const MovingAtoms* atoms_ = nullptr;
  dch::lammps::BoxStep step_;
  Limits limits_;
  std::vector<std::array<std::int32_t, 2> > ends_;  ///< LAMMPS's indices, the atom of smaller ID first
  std::vector<dch::Vec3> middles_;
  std::vector<float> radii_;
  std::size_t owned_ = 0;
  bigint undetermined_ = 0;
  double stretch_ = 1, radius_ = 0, largest_extent_ = 0;
};

}  // namespace LAMMPS_NS
