// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hierarchy/structure.hpp"
#include "new_tree.hpp"

namespace dch::detail {

/// The part of a PointTree that a hierarchy has: its nodes down to leaves and to points on their own. Balls
/// are yet to be measured.
class UpperNodes {
 public:
  explicit UpperNodes(const Structure& structure);

  NewTree tree;

 private:
  struct Subtree {
    std::int32_t level, node;  ///< level 0: a point that is in no leaf, by its id
  };
  void count_points();
  std::int32_t count(Subtree at) const;
  Vec3 site(Subtree at) const;
  void list_children(Subtree of, std::vector<Subtree>& children) const;
  Subtree pass_only_children(Subtree at) const;
  void add_children(std::size_t parent, const std::vector<Subtree>& children);
  void take_points(Subtree of, std::size_t place);

  const Structure& structure_;
  std::vector<std::vector<std::int32_t>> count_;  ///< by level and node: points below
  std::vector<Subtree> subtree_;                  ///< by node
};

}  // namespace dch::detail
