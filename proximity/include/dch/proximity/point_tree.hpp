// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// A hierarchy at full depth: a tree from all points down to single ones, with a measured ball at each node.
///
/// Above the leaves its nodes are those of the hierarchy, which ends at leaves of many points, as lists need.
/// Inside a leaf it goes on with nested nets (thesis 5.2): discrete centers of radius R_0 2^-k, each point
/// below the nearest of them, until points are single or coincide. A node with one child is left out. Balls
/// are measured from the points below, not summed up over the levels, so they are right and tight whether or
/// not a repair is put off. No hypothesis on density, motion or box: the triangle inequality of nearest
/// images is all that is used.
///
/// An object of its own: it stays as it is when the hierarchy changes, and it is constant, so several threads
/// may use it.
class PointTree {
 public:
  struct Node {
    Vec3 center;        ///< of the ball, in the cell; the wrapped point if there is one alone
    double radius = 0;  ///< distance of the farthest point below at most; 0 if all coincide [length]
    double reach = 0;   ///< the same from the representative [length]
    std::int32_t representative = -1;            ///< id of the point below nearest to the center
    std::int32_t first_child = 0, children = 0;  ///< nodes in a row; none or more than one
    std::int32_t first_point = 0, points = 0;    ///< the points below: in a row in ids()
  };

  /// O(n lg alpha) for n points of aspect ratio alpha.
  /// @throws InvalidParameter for so many points that 32-bit numbers might not name all nodes: above 2^30.
  explicit PointTree(const HierarchyView& view);

  std::size_t size() const { return ids_.size(); }  ///< number of points
  /// One more than the largest id that the hierarchy had in use.
  std::size_t capacity() const { return positions_.size(); }
  /// The root first, children behind their parents; fewer than two a point, none without points.
  const std::vector<Node>& nodes() const { return nodes_; }
  const Node& node(std::int32_t k) const { return nodes_[static_cast<std::size_t>(k)]; }
  /// All points, those below a node in a row.
  const std::vector<std::int32_t>& ids() const { return ids_; }
  Span<const std::int32_t> points_below(const Node& node) const {
    return {ids_.data() + node.first_point, static_cast<std::size_t>(node.points)};
  }

  const Box& box() const { return box_; }
  bool contains(std::int32_t id) const;
  /// As given, of a point that there is.
  Vec3 position(std::int32_t id) const { return positions_[static_cast<std::size_t>(id)]; }
  /// Of the nearest images of two points that there are [length^2].
  double distance2(std::int32_t a, std::int32_t b) const { return box_.distance2(position(a), position(b)); }
  /// How far distances of points as given may be from those of wrapped points, which balls are measured by: 0
  /// without a periodic box, else about 1e-14 of the box, more if points lie very many boxes away [length].
  double rounding() const { return rounding_; }
  /// R_0 of the hierarchy [length].
  double base_radius() const { return base_radius_; }

 private:
  Box box_;
  double rounding_ = 0, base_radius_ = 0;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> ids_;
  std::vector<Vec3> positions_;   ///< by id
  std::vector<bool> is_present_;  ///< by id
};

}  // namespace dch
#pragma GCC visibility pop
