// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/vec3.hpp>

#include "question.hpp"
#include "simplex.hpp"

namespace dch::zonotope {

/// The point of a zonotope around the origin that is closest to a point.
struct ClosestPoint {
  Vec3 from_point;         ///< from the point to the closest one; 0 if it is inside
  double lower_bound = 0;  ///< of the distance
  Vec3 last_direction;     ///< along which a support was computed last
  Simplex simplex;         ///< of vertices of the zonotope, less the point
  int iterations = 0;
};

/// @param decided_only ends as soon as the point is proven to be outside (is_separated) or in the simplex
ClosestPoint closest_point(const Question& question, Vec3 start, bool decided_only);

/// Proof in doubles that a simplex of four vertices holds the point.
bool is_in_simplex(const Question& question, const Simplex& simplex);

}  // namespace dch::zonotope
