// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/necklace/necklace.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// Centers of the beads of one chain, in order along it.
struct Shape {
  std::vector<Vec3> positions;
  bool closed = false;
};

/// The necklace of a shape with the same radius for all beads.
Necklace necklace_of(const Shape& shape, double radius);

/// A chain through all points of a grid of nx x ny x nz, row by row and back, layer by layer and back, with
/// spacing 1: the necklace in the plane (nz = 1) for which Theorem 4.5.1 is tight with n lg n, and that in
/// space for which it is tight with n^(4/3). Radii below 1/2 keep beads apart.
/// @throws InvalidParameter unless all are >= 1 and the product is at most 2^31 - 1.
Shape grid_necklace(std::int32_t nx, std::int32_t ny, std::int32_t nz);

/// A helix about the z axis.
/// @param angle from bead to bead [rad]
/// @param rise from bead to bead [length]
/// @throws InvalidParameter for a negative number of beads or a value that is not finite.
Shape helix(std::int32_t beads, double radius, double angle, double rise);

/// The torus knot T(p, q), a ring that goes p times around the axis and q times through the hole; (2, 3) is
/// the trefoil. Beads are one apart along the curve, which is scaled to fit. Without contact for radii up to
/// 1/2 if there are enough beads: some 60 for the trefoil.
/// @throws InvalidParameter unless p and q are >= 1 and have no common divisor, and beads >= 3.
Shape torus_knot(std::int32_t p, std::int32_t q, std::int32_t beads);

/// The necklace in the plane of Fig. 5.1 of the thesis: two segments with n/c bumps of height c, 2c apart,
/// face each other at a distance of `gap` between the tops of their bumps; a bent segment of 2n beads joins
/// their right ends. 10 n + 2 beads, one apart. As `progress` goes from 0 to 1 the upper segment moves to the
/// left by 2n, and on the way every bump of one passes many of the other. For the changes that the thesis
/// counts the bond has to be longer than twice the gap, so gap < 1/2.
/// @throws InvalidParameter unless 1 <= c, c divides n, n >= 4c + 2, 0 < gap <= 1 and 0 <= progress <= 1.
Shape facing_bumps(std::int32_t n, std::int32_t c, double gap, double progress);

/// 2^k points on the unit circle for which the root of the layered hierarchy is sqrt(k) times as large as
/// that of the wrapped one (Lemma 4.4.3). The last line of reflection, which the thesis's text leaves
/// degenerate, is the perpendicular to the one through O and O_{k-1}.
/// @throws InvalidParameter unless 0 <= k <= 24.
Shape tight_set(std::int32_t k);

}  // namespace dch::necklace
#pragma GCC visibility pop
