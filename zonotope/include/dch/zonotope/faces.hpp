// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/zonotope/zonotope.hpp>

#pragma GCC visibility push(default)
namespace dch::zonotope {

/// A facet of a zonotope: the zonogon of all generators in its plane, a parallelogram if there are two. Of a
/// flat zonotope the two sides.
struct Facet {
  Vec3 center;  ///< [length]
  Vec3 normal;  ///< outward, of any length; one component is 0 for sure if two generators' are
  std::vector<std::size_t> generators;  ///< of the zonotope given, in the plane of the facet, ascending
};

/// How many faces there are.
struct FaceCounts {
  std::int64_t vertices = 0, edges = 0, facets = 0;
};

/// All facets, each next to the opposite one. The generators have to be in canonical form (canonical()), so
/// that each direction is one of them. For each generator the others are sorted around it, without rounding,
/// by the angle of the plane that they share, so that coplanar ones are found side by side; the center of the
/// facet follows from sums over those before and after. n (n - 1) facets for n generators in general
/// position, the bound of O(n^2) of thesis 3.1; O(n^2 log n) time, where the arrangement of the text takes
/// O(n^2). None for less than two generators.
/// @throws InvalidPosition as check()
/// @throws InvalidParameter if two generators are parallel, or one is 0
std::vector<Facet> facets(const Zonotope& z);

/// The corners of a facet, in order around it, of a zonotope in canonical form. O(m log m) for m generators
/// in its plane.
std::vector<Vec3> corners(const Zonotope& z, const Facet& facet);

/// Numbers of faces, by Euler's formula from the facets: n (n - 1) + 2 vertices and 2 n (n - 1) edges in
/// general position.
FaceCounts count_faces(const std::vector<Facet>& facets);

}  // namespace dch::zonotope
#pragma GCC visibility pop
