// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/necklace/enclosing_ball.hpp>

namespace dch::necklace::detail {

/// How far a ball may stick out of one that counts as enclosing it, relative to the radius of that one.
inline constexpr double kContainmentTolerance = 1e-13;

/// Distance from `center` to the far side of a ball [length].
inline double far_side(Vec3 center, const Ball& ball) {
  return std::sqrt(norm2(ball.center - center)) + ball.radius;
}

/// Whether a ball lies in the ball around `center` with radius `reach`.
inline bool inside(const Ball& ball, Vec3 center, double reach) {
  const double room = reach - ball.radius;
  return room >= 0 && norm2(ball.center - center) <= room * room;
}

/// The minimum enclosing ball of those in the basis, with the part of the basis that is needed for it.
EnclosingBall ball_of_basis(Span<const Ball> balls, const Basis& basis);

/// The minimum enclosing ball of a basis and one more ball, which sticks out of that of the basis.
EnclosingBall exchange(Span<const Ball> balls, const Basis& basis, std::int32_t entering);

/// Exchanges bases until no ball sticks out. `farthest(ball, reach)` gives the index of the one that sticks
/// out farthest of those it looks at, and as `reach` the distance of its far side from the center; -1 if none
/// does. Returns how many balls entered the basis.
template <class Farthest>
int pivot(Span<const Ball> balls, EnclosingBall& found, const Farthest& farthest) {
  for (int entered = 0;; ++entered) {
    double reach = 0;
    const std::int32_t entering = farthest(found, reach);
    if (entering < 0) return entered;
    const EnclosingBall next = exchange(balls, found.basis, entering);
    // The radius grows with each exchange, so no basis returns. Where rounding keeps it from growing, what
    // sticks out does so by rounding.
    if (!(next.ball.radius > found.ball.radius)) {
      found.ball.radius = reach;
      return entered;
    }
    found = next;
  }
}

}  // namespace dch::necklace::detail
