// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// A bond over one step: its beads a and b go along straight lines, each at a constant speed, from where they
/// are at time 0 to where they are at time 1 [length].
struct MovingBond {
  Vec3 from_a, from_b, to_a, to_b;
};

/// One bond goes through another.
struct Crossing {
  double time = 0;            ///< from the beginning of the step, 0, to its end, 1
  double on_p = 0, on_q = 0;  ///< where along the bonds, 0 at bead a, 1 at bead b
  Vec3 place;                 ///< on bond P [length]
  /// +1 or -1: by how much it changes the linking number of two rings that run along the bonds from a to b.
  int sign = 0;
};

/// Which test decided a pair of bonds.
enum class EncounterStage {
  zonotope,  ///< the same-time difference stays away from the origin
  cubic,     ///< signs of the cubic beyond their error bounds
  exact      ///< integers of any size
};

/// What happens between two bonds during a step.
struct BondEncounter {
  std::array<Crossing, 3> crossings{};  ///< the first `count`, in ascending order of time
  int count = 0;
  /// Whether the bonds come within the thickness of each other, or touch without one going through the other,
  /// and when they first do. With crossings too if there is a thickness.
  bool contact = false;
  double contact_time = 0;
  double contact_distance = 0;  ///< of their axes then [length]
  EncounterStage decided_by = EncounterStage::zonotope;
};

/// Whether two bonds go through each other, or come within `thickness`, during a step; how often, when and
/// where.
///
/// **Crossings are exact** for the coordinates given: at most three, the roots of a cubic. Doubles decide
/// where signs are beyond error bounds, and integers of any size where they are not. A crossing is where the
/// bonds' interiors meet and the volume that they span changes its sign. What happens at time 0 or 1, or at a
/// bead, and all motions in a plane or along a line are decided by a symbolic perturbation of the beads, the
/// same in all pairs and steps if the beads' numbers are: so an event at the common time of two steps, or at
/// the common bead of two bonds, counts once, and the signs add up to the change of a linking number
/// (docs/crossings.md). Two crossings of opposite signs at one time are a contact.
///
/// **Contacts** are found to a tolerance of 1e-6 of the bonds' size, by conservative advancement: the
/// distance of the segments over their largest relative speed is time in which they cannot touch.
///
/// Spec: the zonotope has the center c_P - c_Q and the five generators b_P/2 + w_P/4, b_Q/2 + w_Q/4,
/// (m_P - m_Q)/2, w_P/4, w_Q/4, where w is by how much the displacements of the two beads differ and m their
/// average. It holds the differences of points of both bonds **at the same time**, so it rejects paths that
/// cross at different times, which the space-time volumes of Theorem 3.6.1 do not.
///
/// O(1). Bonds that share a bead always touch: do not ask for these.
/// @param thickness >= 0 [length]
/// @param beads numbers of the beads: a and b of P, a and b of Q
/// @throws InvalidParameter for a negative thickness or one that is not finite, InvalidPosition for a
/// coordinate
///   that is not finite or larger than kMaxCoordinate.
BondEncounter bond_encounter(const MovingBond& p, const MovingBond& q, double thickness = 0,
                             const std::array<std::uint64_t, 4>& beads = {0, 1, 2, 3});

}  // namespace dch::necklace
#pragma GCC visibility pop
