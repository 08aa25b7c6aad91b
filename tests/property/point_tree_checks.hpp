// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/proximity/point_tree.hpp>

namespace dch {

/// The nodes of a tree, found from the root down: children behind their parents.
inline std::vector<std::int32_t> nodes_from_the_root(const PointTree& tree) {
  std::vector<std::int32_t> found;
  if (tree.size() > 0) found.push_back(0);
  for (std::size_t k = 0; k < found.size(); ++k)
    for (std::int32_t c = 0; c < tree.node(found[k]).children; ++c)
      found.push_back(tree.node(found[k]).first_child + c);
  return found;
}

/// Checks that nodes form a tree with as many points as they say, and that all other places are empty.
inline void check_nodes(const PointTree& tree, const std::string& what) {
  const std::vector<std::int32_t> found = nodes_from_the_root(tree);
  ASSERT_LT(found.size(), 2 * tree.size() + 1) << what;
  ASSERT_LE(tree.nodes().size(), 2 * found.size() + 64) << what;
  std::vector<int> times(tree.nodes().size(), 0);
  for (const std::int32_t k : found) {
    ASSERT_EQ(++times[static_cast<std::size_t>(k)], 1) << what << ", node " << k;
    const PointTree::Node& node = tree.node(k);
    ASSERT_NE(node.children, 1) << what << ", node " << k;
    std::int32_t points = node.children == 0 ? 1 : 0;
    for (std::int32_t c = 0; c < node.children; ++c) {
      ASSERT_EQ(tree.node(node.first_child + c).parent, k) << what;
      points += tree.node(node.first_child + c).points;
    }
    ASSERT_EQ(node.points, points) << what << ", node " << k;
  }
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (times[k] == 1) continue;
    ASSERT_EQ(tree.nodes()[k].points, 0) << what << ", place " << k;
    ASSERT_EQ(tree.nodes()[k].children, 0) << what << ", place " << k;
  }
}

/// Checks the balls of a node against all points below it.
inline void check_ball(const PointTree& tree, const PointTree::Node& node, const std::string& what) {
  const Box& box = tree.box();
  const Vec3 representative = box.wrap(tree.position(node.representative));
  bool is_below = false, coincide = true;
  for (const std::int32_t id : tree.points_below(node)) {
    const Vec3 at = box.wrap(tree.position(id));
    is_below = is_below || id == node.representative;
    coincide = coincide && box.distance2(representative, at) == 0;
    ASSERT_LE(box.distance2(node.center, at), node.radius * node.radius) << what << ", point " << id;
    ASSERT_LE(box.distance2(representative, at), node.reach * node.reach) << what << ", point " << id;
  }
  ASSERT_TRUE(is_below) << what;
  ASSERT_EQ(node.radius == 0, node.reach == 0) << what;
  if (node.points == 1) {
    ASSERT_EQ(node.radius, 0) << what;
    ASSERT_EQ(node.center, representative) << what;
  }
}

/// Checks what a tree promises whatever has happened to it, point by point.
/// @param ids of all points, ascending
inline void check_kept_tree(const PointTree& tree, const std::vector<std::int32_t>& ids,
                            const std::string& what) {
  ASSERT_EQ(tree.size(), ids.size()) << what;
  std::vector<std::int32_t> held(tree.ids().begin(), tree.ids().end());
  std::sort(held.begin(), held.end());
  ASSERT_EQ(held, ids) << what;
  for (std::int32_t id = -1; id <= static_cast<std::int32_t>(tree.capacity()); ++id)
    ASSERT_EQ(tree.contains(id), std::binary_search(ids.begin(), ids.end(), id)) << what << ", point " << id;
  ASSERT_NO_FATAL_FAILURE(check_nodes(tree, what));
  const std::vector<std::int32_t> nodes = nodes_from_the_root(tree);
  std::vector<std::vector<std::int32_t>> below(tree.nodes().size());
  for (auto k = nodes.rbegin(); k != nodes.rend(); ++k) {
    const PointTree::Node& node = tree.node(*k);
    std::vector<std::int32_t>& points = below[static_cast<std::size_t>(*k)];
    if (node.children == 0) points.push_back(node.representative);
    for (std::int32_t c = 0; c < node.children; ++c) {
      const auto& more = below[static_cast<std::size_t>(node.first_child + c)];
      points.insert(points.end(), more.begin(), more.end());
    }
    const PointTree::PointsBelow listed = tree.points_below(node);
    ASSERT_EQ(std::vector<std::int32_t>(listed.begin(), listed.end()), points) << what << ", node " << *k;
    ASSERT_NO_FATAL_FAILURE(check_ball(tree, node, what)) << "node " << *k;
  }
}

}  // namespace dch
