// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <dch/base/vec3.hpp>
#include <dch/zonotope/zonotope.hpp>

#pragma GCC visibility push(default)
namespace dch::zonotope {

/// What walks took. Counts are added up.
struct FaceWalkStats {
  std::int64_t steps = 0;       ///< from a facet to one beside it
  std::int64_t operations = 0;  ///< comparisons within the trees of hulls
  std::int64_t searches = 0;    ///< point locations: at the start, and where a walk was given up
};

/// Follows the facet of a zonotope that the ray from its center to a moving point meets, and with it the norm
/// of the point: whether and how far it is inside or outside, in that metric. A step goes to one of the
/// facets that share an edge, without a list of facets (thesis 3.5.6, Lemma 3.5.6). For two zonotopes in
/// translation let the zonotope be difference() of them and the point the origin; for their Euclidean
/// distance give gjk.hpp the direction of the step before.
///
/// The generators are points of a projective plane, and a facet is the line through two of them, which parts
/// the others in two; a step turns the line around one of the two points until it meets the next one: a
/// tangent to the hulls of both parts. Those are kept in trees after Overmars and van Leeuwen. O(n) memory;
/// O(n log^2 n) for the start, O(log^2 n) for the tangents of a step; the two points that a step moves from
/// one hull to another take O(log^3 n) here, one logarithm more than in the text, since common tangents are
/// found by nested searches.
///
/// In doubles: the facet may be one beside that of exact arithmetic where the ray passes within rounding of
/// an edge. Where coplanar generators or rounding lead a walk astray it is given up for point location, which
/// is counted.
class FaceWalk {
 public:
  /// @throws InvalidParameter if the generators do not span space to rounding; InvalidPosition as check()
  explicit FaceWalk(const Zonotope& z);
  FaceWalk(FaceWalk&&) noexcept;
  FaceWalk& operator=(FaceWalk&&) noexcept;
  ~FaceWalk();

  /// Walks to the facet that the ray to a point meets, and returns norm(z, point - center). The center
  /// itself, whose norm is 0, leaves the walk where it is.
  /// @throws InvalidPosition for a point that is not finite or beyond kMaxMagnitude
  double move_to(Vec3 point);

  /// The outward normal of the facet last walked to, of any length.
  Vec3 normal() const;
  /// The zonotope in canonical form, to which the numbers of generators belong.
  const Zonotope& zonotope() const;
  /// Two generators of that facet.
  std::size_t first_generator() const;
  std::size_t second_generator() const;

  const FaceWalkStats& stats() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch::zonotope
#pragma GCC visibility pop
