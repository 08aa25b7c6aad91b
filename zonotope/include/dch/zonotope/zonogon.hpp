// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/zonotope/vec2.hpp>

#pragma GCC visibility push(default)
namespace dch::zonotope {

/// A zonotope in the plane: the points center + sum of delta_k generators[k] with -1 <= delta_k <= 1.
/// Generators may be zero, parallel or none at all.
struct Zonogon {
  Vec2 center;                   ///< [length]
  std::vector<Vec2> generators;  ///< half of each edge [length]
};

/// @throws InvalidPosition that names a center or generator which is not finite or beyond kMaxMagnitude of
/// zonotope.hpp
void check(const Zonogon& z);

/// The Minkowski sum {p + q} and the Minkowski difference {p - q}; the center is rounded. O(n).
Zonogon sum(const Zonogon& a, const Zonogon& b);
Zonogon difference(const Zonogon& a, const Zonogon& b);

/// max of direction . p over the points p. O(n).
double support(const Zonogon& z, Vec2 direction);
/// A point where it is reached; where an edge does, its middle. O(n).
Vec2 support_point(const Zonogon& z, Vec2 direction);

/// 4 times the sum of |v x w| over all pairs of generators [length^2], by slopes: O(n log n).
/// @throws InvalidPosition as check()
double area(const Zonogon& z);

/// The 2 m vertices for m directions of generators, counterclockwise, by sorted slopes; one vertex without
/// generators, two of a segment. O(n log n).
/// @throws InvalidPosition as check()
std::vector<Vec2> vertices(const Zonogon& z);

/// The same set with parallel generators, decided without rounding, merged and zero ones left out, each with
/// x > 0, or x = 0 and y > 0, by ascending slope. O(n log n).
/// @throws InvalidPosition as check()
Zonogon canonical(const Zonogon& z);

/// Whether a point is in a zonogon, which is closed: the answer of exact arithmetic with the given doubles.
/// O(n log n), and without rounding where the point is near the boundary.
/// @throws InvalidPosition as check(), and for such a point
bool contains(const Zonogon& z, Vec2 point);
/// Whether two have a point in common, likewise (Lemma 3.5.1).
bool intersect(const Zonogon& a, const Zonogon& b);

/// What a minimum took.
struct ZonogonStats {
  int rounds = 0;               ///< lines along which the minimum was found
  std::int64_t operations = 0;  ///< comparisons, and edges looked at
};

/// The zonogon of least area that holds all points (thesis 3.4.1, Theorem 3.4.5), in expected O(n log^2 n).
/// With center O it is the hull of the points and their reflections through O, and its area
///   f(O) = C + sum over edges t of the points' hull of 2 L_t max(0, n_t . O - m_t),
/// L_t the length of the edge, n_t its inward normal and m_t where O is halfway from the edge to the farthest
/// point (Lemma 3.4.1): convex, so that a random search over the vertices of the arrangement of these lines,
/// in the place of slope selection, finds a minimum. It need not be unique, against Lemma 3.4.3 and
/// Corollary 3.4.4: for a triangle f is constant over the medial triangle. Slopes to either side decide in
/// such flat parts too.
///
/// Each point is within 1e-14 of the points' extent of the zonogon. One point gives a point, points on a line
/// a segment.
/// @throws InvalidParameter if there are no points; InvalidPosition for one that is not finite or beyond
/// kMaxMagnitude
Zonogon min_area_zonogon(Span<const Vec2> points, ZonogonStats* stats = nullptr);

/// The zonogon of least area with a given center that holds all points: the hull of the points and their
/// reflections. O(n log n). Throws as min_area_zonogon(), for the center too.
Zonogon enclosing_zonogon(Span<const Vec2> points, Vec2 center);

}  // namespace dch::zonotope
#pragma GCC visibility pop
