// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/vec3.hpp>
#include <dch/zonotope/zonotope.hpp>

#pragma GCC visibility push(default)
namespace dch::zonotope {

/// How a question is decided first. The answer is the same with each.
enum class Method {
  automatic,  ///< by separating axes to 16 generators, then by GJK (gjk.hpp), and where that is too near to
              ///< the boundary by point location
  point_location,  ///< Theorem 3.5.2
  exact            ///< in numbers without rounding throughout
};

/// What answers took. Counts are added up.
struct MembershipStats {
  std::int64_t by_axes = 0;            ///< answers, all of them no
  std::int64_t by_gjk = 0;             ///< answers
  std::int64_t by_point_location = 0;  ///< answers, in doubles with a proof that rounding did not matter
  std::int64_t exact = 0;              ///< answers without rounding, near the boundary and for flat zonotopes
  std::int64_t operations = 0;         ///< of point location: comparisons, and products of generators
  std::int64_t rounds = 0;             ///< of point location: separators that were looked at
};

/// Whether a zonotope, which is closed, contains a point. The answer is that of exact arithmetic with the
/// given doubles: what is decided in doubles comes with a proof that outweighs rounding (a separating
/// direction; or coefficients of the generators), and all else is decided without rounding.
///
/// Thesis 3.5.1, Theorem 3.5.2: implicit point location in expected O(n log^2 n). Departures: the text
/// projects along z and looks up and down; here the projection is along the ray to the point, so that it is
/// always within the silhouette, one search is enough, and what is found is the facet that the ray meets.
/// Slope selection is randomised. Zero, parallel, coplanar generators and such that point to the point are
/// allowed; the text excludes them. The exact part walks from facet to facet, starting from the one that
/// doubles found: O(n log n) a step, a few of them.
/// @throws InvalidPosition as check(), and for such a point
bool contains(const Zonotope& z, Vec3 point, Method method = Method::automatic,
              MembershipStats* stats = nullptr);

/// Whether two zonotopes have a point in common: whether that of the generators of both contains the
/// difference of the centers (Lemma 3.5.1), which is not rounded. Otherwise as contains().
bool intersect(const Zonotope& a, const Zonotope& b, Method method = Method::automatic,
               MembershipStats* stats = nullptr);

/// Whether all points of a zonotope are in another one: along each normal of the outer one's facets it
/// reaches as far. Decided without rounding where doubles do not suffice. O(n^2 (n + m)) for n generators of
/// the outer and m of the inner one.
/// @throws InvalidPosition as check()
bool encloses(const Zonotope& outer, const Zonotope& inner);

}  // namespace dch::zonotope
#pragma GCC visibility pop
