// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/proximity/spanning_tree.hpp>

#include "components.hpp"
#include "hierarchy/structure.hpp"
#include "hierarchy/subtree_balls.hpp"

namespace dch::detail {

/// Finds the nearest point of another component.
template <class Metric>
class ForeignDescent {
 public:
  ForeignDescent(const Metric& metric, const Structure& structure, const SubtreeBalls& balls);

  /// To be called when components have been joined.
  /// @param component by id
  void label(const std::vector<std::int32_t>& component);

  /// Puts the shortest edge from a point to one of another component in place of `best` if it comes before
  /// that.
  void search(std::int32_t id, TreeEdge& best);

 private:
  static constexpr std::int32_t kMixed = -2;
  struct Subtree {
    double distance;
    std::int32_t level, node;
    bool operator<(const Subtree& other) const { return distance > other.distance; }
  };
  void push(int level, std::int32_t node, const TreeEdge& best);
  void look_at_leaf(std::int32_t node, TreeEdge& best);
  void look_at_point(std::int32_t id, TreeEdge& best);
  double limit(const TreeEdge& best) const;

  const Metric& metric_;
  const Structure& structure_;
  const SubtreeBalls& balls_;
  double slack_;
  const std::vector<std::int32_t>* component_ = nullptr;
  std::vector<std::vector<std::int32_t>>
      of_node_;                   ///< by level: the component of all points below, or kMixed
  std::vector<Subtree> waiting_;  ///< a heap
  std::int32_t id_ = -1;          ///< whose neighbor is looked for
  Vec3 at_;                       ///< its wrapped position
};

}  // namespace dch::detail
