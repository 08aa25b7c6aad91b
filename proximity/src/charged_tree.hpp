// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/proximity/point_tree.hpp>

#include "expansions.hpp"

namespace dch::detail {

/// A node of a PointTree with what sums over its charges need. Lengths are in units of the tree.
struct ChargedNode {
  Vec3 center;         ///< of the absolute charges
  double radius = 0;   ///< of the farthest point
  double weight = 0;   ///< sum of the absolute charges
  double spread2 = 0;  ///< mean squared distance of them
  double reach = 0;    ///< power mean of their distances, of the power that Truncation needs
  std::int32_t first_child = 0, children = 0;
  std::int32_t first = 0, points = 0;  ///< places in the order of the PointTree
  std::int32_t charges = 0;  ///< of them that sums go over: the first alone if all coincide, with all charge
  bool is_bottom() const { return children == 0; }
};

/// The upper part of a PointTree, down to nodes of few points, with charges in one image of each point: such
/// that distances inside the tree are those of space, without a box. Lengths are in units of about the radius
/// of all points, a power of two, so that squared ones stay within the range of numbers.
class ChargedTree {
 public:
  /// @param power at least 1, of the mean that `reach` is
  ChargedTree(const PointTree& tree, Span<const double> charges, int power);

  double unit() const { return unit_; }  ///< [length]
  /// Points coincide if their squared distance is no larger.
  double least2() const { return least2_; }
  const std::vector<ChargedNode>& nodes() const { return nodes_; }
  const ChargedNode& node(std::int32_t k) const { return nodes_[static_cast<std::size_t>(k)]; }
  Vec3 at(std::int32_t place) const { return at_[static_cast<std::size_t>(place)]; }
  double charge(std::int32_t place) const { return charges_[static_cast<std::size_t>(place)]; }

 private:
  void take(const PointTree& tree);
  void place_points(const PointTree& tree, const PointTree::Node& node, Vec3 anchor);
  void measure(ChargedNode& node, int power) const;

  double unit_ = 1, least2_ = 0;
  std::vector<ChargedNode> nodes_;
  std::vector<Vec3> at_;
  std::vector<double> charges_, weights_;
};

/// Multipole expansions of all nodes, whole ones while they are made, then short ones.
std::vector<double> multipoles_of(const ChargedTree& tree, const Expansions& expansions);

}  // namespace dch::detail
