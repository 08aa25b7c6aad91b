// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <dch/base/vec3.hpp>

#include "exact.hpp"

namespace dch::zonotope {

/// Whether sum of [-1, 1] generators contains point + tail. None of the generators is 0.
struct Question {
  std::vector<Vec3> generators;
  Vec3 point, tail;  ///< the tail is what point, a rounded difference, lacks

  ExactVec exact_point() const { return exact(point) + exact(tail); }
};

/// Proof in doubles that the point is outside: normal . point exceeds sum |normal . generator| by more than
/// rounding can have done.
bool is_separated(const Question& question, Vec3 normal);

/// Proof in doubles that the point is inside: coefficients within [-1, 1] of the generators whose sum is the
/// point but for a rest that three of the generators take up, rounding included.
/// @param normal about that of the facet that the ray to the point meets
/// @param i, j two generators of the facet that are not parallel
bool is_inside(const Question& question, Vec3 normal, std::size_t i, std::size_t j);

/// Along the normal of the facet that the ray to the point meets, without rounding: how far the zonotope
/// reaches, and where the point is. It is inside if it is within reach. Both are 0 for the origin; a reach of
/// 0 and a height above it show that the point is not in the space of the generators.
struct Reach {
  Exact support, height;
  bool contains() const { return (support - height).sign() >= 0; }
};

/// @param i, j of a facet to begin with, if both are numbers of generators
Reach exact_reach(const Question& question, std::size_t i = SIZE_MAX, std::size_t j = SIZE_MAX);

/// The facet that the ray from the origin to the point meets, by point location in doubles.
struct MetFacet {
  Vec3 normal;
  std::size_t i = SIZE_MAX, j = SIZE_MAX;
  double support = 0, height = 0;  ///< along the normal: how far the zonotope reaches, and where the point is
  int rounds = 0;
  std::int64_t operations = 0;
};
MetFacet facet_towards(const Question& question);

}  // namespace dch::zonotope
