// SPDX-License-Identifier: MIT
#include <dch/necklace/enclosing_ball.hpp>

#include "balls/ball_basis.hpp"

namespace dch::necklace {

namespace {

/// The ball whose far side is farthest from the center, if it sticks out.
std::int32_t farthest_of(Span<const Ball> balls, const EnclosingBall& found, double& reach) {
  const Vec3 center = found.ball.center;
  reach = found.ball.radius * (1 + detail::kContainmentTolerance);
  std::int32_t farthest = -1;
  for (std::size_t k = 0; k < balls.size(); ++k) {
    if (detail::inside(balls[k], center, reach)) continue;
    farthest = static_cast<std::int32_t>(k);
    reach = detail::far_side(center, balls[k]);
  }
  return farthest;
}

}  // namespace

EnclosingBall enclosing_ball(Span<const Ball> balls) { return enclosing_ball(balls, {}); }

EnclosingBall enclosing_ball(Span<const Ball> balls, const Basis& guess) {
  if (balls.empty()) return {};
  Basis first = guess;
  if (first.size == 0) first = {{0, -1, -1, -1}, 1};
  EnclosingBall found = detail::ball_of_basis(balls, first);
  detail::pivot(balls, found,
                [&](const EnclosingBall& now, double& reach) { return farthest_of(balls, now, reach); });
  return found;
}

}  // namespace dch::necklace
