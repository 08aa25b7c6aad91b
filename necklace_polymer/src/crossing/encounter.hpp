// SPDX-License-Identifier: MIT
#pragma once

#include <dch/necklace/bond_encounter.hpp>

#include "crossing/pair_ends.hpp"
#include "crossing/pair_motion.hpp"

namespace dch::necklace::detail {

/// A bond over one step as the zonotope of its sweep: the center, and what it adds to the generators.
struct BondSweep {
  explicit BondSweep(const MovingBond& bond)
      : center(0.25 * ((bond.from_a + bond.from_b) + (bond.to_a + bond.to_b))),
        along(0.25 * ((bond.from_b - bond.from_a) + (bond.to_b - bond.to_a))),
        motion(0.25 * ((bond.to_a - bond.from_a) + (bond.to_b - bond.from_b))),
        twist(0.25 * ((bond.to_b - bond.from_b) - (bond.to_a - bond.from_a))) {}

  /// No point of it is farther from the center at any time.
  double radius() const {
    return std::sqrt(norm2(along)) + std::sqrt(norm2(motion)) + std::sqrt(norm2(twist));
  }

  /// Of an axis-parallel box around the center that holds it at all times.
  Vec3 half_widths() const {
    const auto along_axis = [&](int axis) {
      return std::abs(along[axis]) + std::abs(motion[axis]) + std::abs(twist[axis]);
    };
    return {along_axis(0), along_axis(1), along_axis(2)};
  }

  Vec3 center;
  Vec3 along;   ///< b/2 + w/4
  Vec3 motion;  ///< m/2
  Vec3 twist;   ///< w/4
};

/// Whether two bonds stay farther apart than `margin`, by the box or by the zonotope of their difference.
bool is_apart_by_box(const BondSweep& p, const BondSweep& q, Vec3 between, double margin);
bool is_apart_by_zonotope(const BondSweep& p, const BondSweep& q, Vec3 between, double margin);

/// The crossings by doubles. False if these cannot decide; then `out` has none.
bool crossings_by_cubic(const PairMotion& motion, BondEncounter& out);
/// The crossings, whatever the motion. True if the bonds may touch otherwise.
bool crossings_by_integers(const PairMotion& motion, const PairEnds& ends, BondEncounter& out);
/// Notes the first time at which the bonds are within `distance`, up to a tolerance, if there is one.
void note_contact(const PairMotion& motion, double distance, BondEncounter& out);

}  // namespace dch::necklace::detail
