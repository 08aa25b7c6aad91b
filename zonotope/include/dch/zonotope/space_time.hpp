// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/vec3.hpp>
#include <dch/zonotope/zonotope.hpp>

#pragma GCC visibility push(default)
namespace dch::zonotope {

/// A rigid motion over a step: a turn around an axis and a translation, both in proportion to the time s,
/// which goes from 0 to 1.
struct RigidMotion {
  Vec3 translation;  ///< over the whole step [length]
  Vec3 axis_point;   ///< a point of the axis, which moves along with the body [length]
  Vec3 axis;         ///< its direction, of any length; not 0 if there is a turn
  double angle = 0;  ///< of the turn over the whole step, by the right hand [rad]
};

/// Where a body is at time s.
/// @throws InvalidParameter for an s outside of 0..1, an angle that is not finite, or an axis of 0 with a
/// turn
/// @throws InvalidPosition as check(), and for vectors of the motion likewise
Zonotope placed(const Zonotope& body, const RigidMotion& motion, double s);

/// A zonotope that holds the body at all times from one to another: the body at the first with three more
/// generators (Theorem 3.6.1; two without a turn, one for a turn around a generator's own line). Corrected:
/// with coefficients within
/// [-1, 1] the generator of a translation v is v/2, and the center moves by v/2; those of a turn are two
/// perpendicular ones of 2 rho sin(theta/2), rho the distance of the body's farthest vertex from the axis,
/// without an offset of the center. A volume in space: it says nothing of when the body is where. Everything
/// that rounds is rounded up by 1e-14 of the sizes. O(n log n).
/// @throws InvalidParameter as placed(), and for a turn by 180 degrees or more within the times, where the
/// theorem does
///   not hold: split the step
Zonotope swept_volume(const Zonotope& body, const RigidMotion& motion, double from = 0, double to = 1);

/// Whether two bodies meet while they move.
enum class Meeting {
  none,      ///< they do not: all of the step is covered by volumes that are apart
  contact,   ///< they intersect at the time given, the first that was found
  undecided  ///< they pass so close that the tolerance does not tell: within the times given
};

struct FirstMeeting {
  Meeting outcome = Meeting::none;
  double from = 1, to = 1;     ///< they do not meet before `from`; of a contact, they intersect at `to`
  std::int64_t intervals = 0;  ///< pairs of swept volumes that were tested
};

/// Cuts the time in halves wherever swept volumes intersect (thesis 3.6), the earlier half first, down to
/// intervals of the tolerance; there a placement where the bodies intersect is a contact. The text's
/// bisection need not end where bodies graze each other without entering: here it ends as undecided. A step
/// cut d times takes up to 2 (d + 1) intervals to reach the first time in doubt, more where bodies pass each
/// other closely. Exact where it compares volumes, but for how the placements round.
/// @param tolerance of the time, within 1e-12..1
/// @throws as swept_volume() but for turns by 180 degrees and more, which are split; InvalidParameter for a
/// tolerance out
///   of range
FirstMeeting first_meeting(const Zonotope& a, const RigidMotion& motion_a, const Zonotope& b,
                           const RigidMotion& motion_b, double tolerance);

}  // namespace dch::zonotope
#pragma GCC visibility pop
