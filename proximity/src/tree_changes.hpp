// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/proximity/point_tree.hpp>

#include "tree_rows.hpp"

namespace dch::detail {

struct Structure;

/// What an update does to a PointTree. A node has a net of some radius, whose centers are the sites of its
/// children: more than the radius apart, and each point below a child within it of the child's site. The ball
/// of the node is at most twice as large when it is made, so that children are O(1). Sites stay where they
/// are when points go, so points can come and go one by one.
class TreeChanges {
 public:
  TreeChanges(PointTree& tree, const Structure& structure)
      : tree_(tree), structure_(structure), rows_(tree) {}

  void insert(std::int32_t id);
  /// Of several points.
  void remove(std::int32_t id);
  /// Has points move and the balls above them grow. Returns those that are farther from their site than nets
  /// allow, and need another place, ascending.
  /// @param at_once all balls are looked at once, and all points that have moved are taken, else those above
  /// each of the points
  std::vector<std::int32_t> move(const std::vector<std::int32_t>& moved, bool at_once);
  void close_gaps() { rows_.close_gaps(); }

 private:
  PointTree::Node& node(std::int32_t k) { return tree_.nodes_[static_cast<std::size_t>(k)]; }
  TreeNet& net(std::int32_t k) { return tree_.nets_[static_cast<std::size_t>(k)]; }
  double distance(Vec3 a, Vec3 b) const;
  Vec3 place_now(std::int32_t id) const;

  std::int32_t place_for(Vec3 at);
  std::int32_t nearest_child(std::int32_t k, Vec3 at, double& apart);
  std::int32_t smallest_child(std::int32_t k);
  void put_above(std::int32_t k, Vec3 at, double apart);
  void add_leaf(std::int32_t k, std::int32_t id, Vec3 at);
  Vec3 center_of(std::int32_t id);
  void choose_representative(std::int32_t k);
  void grow(std::int32_t k, Vec3 at);
  void note_change(std::int32_t k);
  bool strays(std::int32_t leaf, Vec3 at);
  void move_alone(std::int32_t id);
  double move_below(std::int32_t k);
  void ask_for_places(std::int32_t first, std::int32_t end);
  double move_leaf(std::int32_t k);
  void measure(std::int32_t k);

  PointTree& tree_;
  const Structure& structure_;
  TreeRows rows_;
  std::vector<std::int32_t> strayed_;
  // Of the node that is measured
  std::vector<Vec3> at_;
  std::vector<std::int32_t> ids_;
};

}  // namespace dch::detail
