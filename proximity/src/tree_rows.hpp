// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/proximity/point_tree.hpp>

namespace dch::detail {

/// Where the nodes of a PointTree stand: the children of a node in a row with some room, so that one that
/// comes or goes moves its siblings at most. Rows that are given up are used again. A node that is moved
/// leaves a place with nothing in it.
class TreeRows {
 public:
  explicit TreeRows(PointTree& tree) : tree_(tree) {}

  /// A new child behind the others of a node, which may all move. Returns its number.
  /// @throws InvalidParameter for more places than 32-bit numbers name.
  std::int32_t append(std::int32_t parent);
  /// Takes a child out of its row. The last one of the row is put in its place.
  void erase(std::int32_t erased);
  /// Puts a new node in the place of another one, which becomes its only child. Returns the number of that.
  std::int32_t push_down(std::int32_t above);
  /// Puts an only child in the place of its parent.
  void pull_up(std::int32_t above);
  /// Puts all nodes side by side if they take less than half of the places: children behind their parents.
  void close_gaps();

 private:
  PointTree::Node& node(std::int32_t k) { return tree_.nodes_[static_cast<std::size_t>(k)]; }
  TreeNet& net(std::int32_t k) { return tree_.nets_[static_cast<std::size_t>(k)]; }
  std::int32_t take_row(std::int32_t room);
  void give_row(std::int32_t first, std::int32_t room);
  void move(std::int32_t from, std::int32_t to);

  PointTree& tree_;
};

}  // namespace dch::detail
