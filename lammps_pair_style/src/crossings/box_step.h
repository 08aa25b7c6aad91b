// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>

#include <dch/base/vec3.hpp>

namespace dch::lammps {

/// LAMMPS's box: x = low + H s, H upper triangular, in LAMMPS's Voigt order xx, yy, zz, yz, xz, xy [length].
struct Cell {
  std::array<double, 6> h{1, 1, 1, 0, 0, 0};
  Vec3 low;
  std::array<bool, 3> periodic{};

  Vec3 vector(Vec3 n) const {
    return {h[0] * n.x + h[5] * n.y + h[4] * n.z, h[1] * n.y + h[3] * n.z, h[2] * n.z};
  }
  /// The coordinates n of a vector H n.
  Vec3 coordinates(Vec3 d) const;
  /// The number of periodic vectors to be taken off d so that it is shortest, where the shortest is below
  /// half_height().
  Vec3 nearest(Vec3 d) const;
  /// Of the lowest height over periodic faces; infinity if nothing is periodic [length].
  double half_height() const;

  friend bool operator==(const Cell& a, const Cell& b) {
    return a.h == b.h && a.low == b.low && a.periodic == b.periodic;
  }
};

/// How often an atom went through the faces of the box (LAMMPS's image flags).
using BoxCounts = std::array<int, 3>;

/// The box at two times, and what belongs together in it. Each image of an atom moves on a straight line,
/// with lattice vectors that go linearly from those before to those now: so images of two atoms that are near
/// each other move alike whichever image of the pair is looked at.
///
/// Between the two times LAMMPS may have put another basis of the same lattice in place of the tilted one
/// (fix nh, fix deform: `flip`). That is undone: before() is the old lattice in the basis that differs least
/// from the new one, which is right while the tilts change by less than half an edge otherwise.
class BoxStep {
 public:
  BoxStep() = default;
  BoxStep(const Cell& before, const Cell& now);

  const Cell& before() const { return before_; }
  const Cell& now() const { return now_; }
  /// Halfway between the two.
  const Cell& middle() const { return middle_; }
  /// Whether both are periodic along the same vectors: otherwise images have no past.
  bool comparable() const { return before_.periodic == now_.periodic; }

  /// Whether the lattice has the basis that it had.
  bool same_basis() const { return flip_ == std::array<int, 3>{}; }

  /// Whether the lattice is the same before and now.
  bool is_still() const { return same_; }
  /// By how much a change of the lattice alone takes two points apart that are d apart halfway [length].
  Vec3 drift(Vec3 d) const;
  /// By how much it takes a point along [length].
  Vec3 drift_of_point(Vec3 x) const { return (now_.low - before_.low) + drift(x - middle_.low); }
  /// drift(d) is at most this times as long as d.
  double strain() const;

  /// Where the image of an atom was that now has image flags `flags`: the atom's old position, moved by
  /// vectors of the old lattice.
  Vec3 start(Vec3 position, const BoxCounts& flags_then, const BoxCounts& flags) const;

  /// The squared length of what an image moved against the lattice, along its periodic vectors [length^2].
  double moved2(Vec3 start, Vec3 end) const;

 private:
  Cell before_, now_, middle_;
  std::array<int, 3> flip_{};  ///< multiples of b in c, a in c and a in b that were added: yz, xz, xy
  bool same_ = false;
};

}  // namespace dch::lammps
