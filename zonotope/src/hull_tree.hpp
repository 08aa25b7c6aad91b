// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/zonotope/vec2.hpp>

namespace dch::zonotope {

/// The lower hull of a changing subset of points that are known beforehand, sorted by x (M. Overmars and J.
/// van Leeuwen, J. Comput. Syst. Sci. 23:166, 1981): a balanced tree over all of them, each of whose nodes
/// has the common tangent, the bridge, of the hulls of its two halves. O(log n) to ask for a tangent through
/// a point, times the O(log n) nodes of a range; O(log^3 n) to add a point or take one out, since a bridge is
/// found by a search within a search.
class HullTree {
 public:
  static constexpr std::size_t kNone = SIZE_MAX;

  /// @param points sorted by x; none is in the subset yet. They have to outlive the tree.
  /// @param is_upper for the upper hull
  HullTree(Span<const Vec2> points, bool is_upper);

  void assign(const std::vector<bool>& is_in);
  void insert(std::size_t point) { change(point, true); }
  void erase(std::size_t point) { change(point, false); }

  /// Of the points first..last-1 of the subset, all on one side of `from`, the one that a line through `from`
  /// meets first as its slope rises from -infinity, or falls from infinity: on this hull if the hull is the
  /// one that faces that way.
  std::size_t first_met(std::size_t from, std::size_t first, std::size_t last, bool is_rising) const;

  std::int64_t operations() const { return operations_; }

 private:
  struct Node {
    std::size_t left = kNone,
                right = kNone;  ///< the bridge; both the point of a leaf; of a node with one half its own
    bool is_empty = true;
  };

  void change(std::size_t point, bool is_in);
  void join(std::size_t node);
  std::size_t lowest(std::size_t node, Vec2 direction) const;
  std::size_t tangent(std::size_t node, std::size_t from, bool is_rising) const;
  Vec2 at(std::size_t point) const { return {points_[point].x, sign_ * points_[point].y}; }

  Span<const Vec2> points_;
  double sign_;
  std::size_t leaves_ = 1;
  std::vector<Node> nodes_;  ///< 1 is the root, 2 k and 2 k + 1 are the halves of k
  mutable std::int64_t operations_ = 0;
};

}  // namespace dch::zonotope
