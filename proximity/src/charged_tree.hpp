// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/proximity/point_tree.hpp>

#include "expansions.hpp"
#include "moment_sizes.hpp"

namespace dch::detail {

/// A node with what sums over its charges need. Lengths are in units of the tree.
struct ChargedNode {
  Vec3 center;            ///< of the absolute charges
  double radius = 0;      ///< of the farthest point
  double weight = 0;      ///< sum of the absolute charges
  double spread2 = 0;     ///< mean squared distance of them
  double reach = 0;       ///< power mean of their distances, of the power that Truncation needs
  MomentSizes moments{};  ///< over the weight and over the radius to the degree
  std::int32_t first_child = 0, children = 0;
  std::int32_t first = 0, points = 0;  ///< places
  std::int32_t charges = 0;  ///< of them that sums go over: the first alone if all coincide, with all charge
  bool is_bottom() const { return children == 0; }
};

/// A tree of nodes of two children, down to few points, over the charges in one image of each point, so that
/// distances inside the tree are those of space, without a box. A node is halved across the longest side of
/// the box around its points, as in a fair-split tree: two children suit a descent better than the ten of a
/// net, as sources and targets are taken at the size at which errors allow it. Lengths are in units of about
/// the radius of all points, a power of two, so that squared ones stay within the range of numbers.
class ChargedTree {
 public:
  /// @param degree 0 or more, up to which moments are measured; `reach` is the mean of the next power
  ChargedTree(const PointTree& tree, Span<const double> charges, int degree);

  double unit() const { return unit_; }  ///< [length]
  /// Points coincide if their squared distance is no larger.
  double least2() const { return least2_; }
  const std::vector<ChargedNode>& nodes() const { return nodes_; }
  const ChargedNode& node(std::int32_t k) const { return nodes_[static_cast<std::size_t>(k)]; }
  std::int32_t id(std::int32_t place) const { return charges_[static_cast<std::size_t>(place)].id; }
  Vec3 at(std::int32_t place) const { return charges_[static_cast<std::size_t>(place)].at; }
  double charge(std::int32_t place) const { return charges_[static_cast<std::size_t>(place)].charge; }

 private:
  struct Charge {
    Vec3 at;
    double charge, weight;
    std::int32_t id;
  };
  void place_charges(const PointTree& tree, Span<const double> charges);
  void split();
  std::int32_t halve(const ChargedNode& node, Vec3 low, Vec3 high, bool by_length);
  void join(ChargedNode& node);
  void measure(ChargedNode& node, int power) const;
  void measure_moments(ChargedNode& node, MeasureMoments& moments) const;

  double unit_ = 1, least2_ = 0;
  std::vector<ChargedNode> nodes_;
  std::vector<Charge> charges_;  ///< by place
};

/// Multipole expansions of all nodes, whole ones while they are made, then short ones.
std::vector<double> multipoles_of(const ChargedTree& tree, const Expansions& expansions);

}  // namespace dch::detail
