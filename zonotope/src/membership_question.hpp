// SPDX-License-Identifier: MIT
#pragma once

#include <dch/zonotope/zonotope.hpp>

#include "question.hpp"

namespace dch::zonotope {

/// Whether two zonotopes intersect: whether that of the generators of both, around 0, holds the difference of
/// the centers (Lemma 3.5.1), to which nothing is lost.
/// @throws InvalidPosition as check()
Question question_of_two(const Zonotope& a, const Zonotope& b);

/// Whether a zonotope contains a point.
/// @throws InvalidPosition as check(), and for such a point
Question question_of_point(const Zonotope& z, Vec3 point);

}  // namespace dch::zonotope
