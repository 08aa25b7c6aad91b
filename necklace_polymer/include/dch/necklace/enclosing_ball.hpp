// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// A closed ball; a point if the radius is 0 [length].
struct Ball {
  Vec3 center;
  double radius = 0;
};

/// The balls that a minimum enclosing ball is determined by: indices, ascending, at most four.
struct Basis {
  std::array<std::int32_t, 4> members{-1, -1, -1, -1};
  std::int32_t size = 0;

  Span<const std::int32_t> indices() const { return {members.data(), static_cast<std::size_t>(size)}; }
  friend bool operator==(const Basis& a, const Basis& b) { return a.members == b.members; }
  friend bool operator!=(const Basis& a, const Basis& b) { return !(a == b); }
};

/// A ball and what it rests on.
struct EnclosingBall {
  Ball ball;
  Basis basis;
};

/// The minimum enclosing ball of balls of any radii (thesis 4.4.2), by exchange of bases: as long as some
/// ball sticks out, the one that does so farthest enters the basis, and the minimum enclosing ball of these
/// at most five is found among all their subsets. This is an LP-type algorithm in the sense of Sharir and
/// Welzl. Welzl's recursion is not valid here: with different radii a ball outside of the minimum ball of the
/// others that touches a given set need not touch that of all (Fischer and Gaertner, Int. J. Comput. Geom.
/// Appl. 14:341, 2004).
///
/// Every ball is inside the result within 1e-13 of its radius, and the radius is within about 1e-12 of the
/// least, relatively; of equal solutions the basis is one of the smallest. No ball gives a ball of radius 0
/// at the origin without a basis. The result depends on the order of the balls by rounding alone, and by
/// which of several bases it names. A handful of passes over the balls; none is proved, as for the simplex
/// method.
/// @throws nothing; centers have to be finite.
EnclosingBall enclosing_ball(Span<const Ball> balls);

/// The same, starting from a set of up to four balls that are thought to be the basis, which saves passes if
/// they nearly are. Its members have to be indices of balls; an empty one is no hint.
EnclosingBall enclosing_ball(Span<const Ball> balls, const Basis& guess);

}  // namespace dch::necklace
#pragma GCC visibility pop
