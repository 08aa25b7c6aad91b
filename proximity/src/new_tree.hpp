// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/proximity/point_tree.hpp>

namespace dch::detail {

/// A PointTree that is being built: children stand behind their parents, and the points below a node in a
/// row.
struct NewTree {
  std::vector<PointTree::Node> nodes;
  std::vector<TreeNet> nets;              ///< by node
  std::vector<std::int32_t> first_point;  ///< by node: a place in `ids`
  std::vector<std::int32_t> ids;

  /// Begins the row of a node's children, behind all nodes.
  void begin_row(std::size_t parent, std::size_t children) {
    nodes[parent].first_child = static_cast<std::int32_t>(nodes.size());
    nodes[parent].children = nets[parent].room = static_cast<std::int32_t>(children);
  }
  /// Adds the next child of the row.
  void add(std::size_t parent, std::int32_t place, std::int32_t points, Vec3 site) {
    PointTree::Node node;
    node.parent = static_cast<std::int32_t>(parent);
    node.points = points;
    nodes.push_back(node);
    nets.push_back({site});
    first_point.push_back(place);
  }
};

}  // namespace dch::detail
