// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <dch/base/span.hpp>
#include <dch/necklace/enclosing_ball.hpp>

namespace dch::necklace::detail {

/// A radius that no ball has: the basis is not all needed, or flat.
inline constexpr double kNotCentral = -1;

/// The minimum enclosing balls of many bases of balls that all have one radius. Each is that of
/// ball_of_basis() to the last bit, or has the radius kNotCentral where only that function can tell. Bases of
/// the same size are taken together, so that no branch depends on one of them and several share an
/// instruction.
void balls_of_bases(Span<const Ball> balls, Span<const Basis> bases, std::vector<Ball>& out);

}  // namespace dch::necklace::detail
