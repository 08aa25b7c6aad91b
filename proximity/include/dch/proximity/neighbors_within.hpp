// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>
#include <dch/proximity/nearest.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// All neighbors of some points within a radius, a row each, nearest first; of points equally near, the one
/// with the smaller id comes first.
struct NeighborsWithinRows {
  std::vector<std::int64_t> first{0};  ///< row i is id[first[i]] .. id[first[i + 1] - 1]
  std::vector<std::int32_t> id;
  std::vector<double> distance2;  ///< the same: squared distances [length^2]
  NearestWork work;               ///< to find them

  std::size_t size() const { return first.size() - 1; }
  Span<const std::int32_t> row(std::size_t i) const {
    return {id.data() + first[i], static_cast<std::size_t>(first[i + 1] - first[i])};
  }
};

/// All neighbors at any radius, larger or smaller than that of the hierarchy (thesis 5.6.6, by descent, for
/// the points that are asked about): those at a distance of nearest images of at most the radius, as
/// ListMaker lists them for all points at the radius of the hierarchy.
///
/// Subtrees are pruned by measured balls, as in Nearest, so answers are right whether or not a repair is put
/// off. An object is good until the hierarchy is next changed; queries are constant. O(lg alpha + k) for k
/// neighbors each, at radii of a leaf or more.
class NeighborsWithin {
 public:
  /// Measures the balls of all subtrees: O(nodes of level 1 and above).
  explicit NeighborsWithin(const HierarchyView& view);
  ~NeighborsWithin();
  NeighborsWithin(NeighborsWithin&&) noexcept;
  NeighborsWithin& operator=(NeighborsWithin&&) noexcept;

  /// The other points within a radius of each of some points.
  /// @throws InvalidParameter for a radius that is negative or NaN, and for an id without a point;
  ///   CutoffTooLarge for a radius above Box::max_cutoff(), where a point may have several images in reach.
  NeighborsWithinRows of_points(Span<const std::int32_t> ids, double radius) const;

  /// The points within a radius of each of some positions, which need not be of points.
  /// @throws InvalidPosition for a coordinate that is not finite or too large; as of_points() otherwise.
  NeighborsWithinRows of_positions(Span<const Vec3> positions, double radius) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch
#pragma GCC visibility pop
