// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/proximity/point_tree.hpp>

namespace dch::detail {

/// Measures the balls of a tree of points, and makes the nodes inside its leaves.
class NestedNets {
 public:
  /// @param positions by id, as given
  NestedNets(const Box& box, double base_radius, const std::vector<Vec3>& positions,
             std::vector<PointTree::Node>& nodes, std::vector<std::int32_t>& ids);

  /// Goes on below each node that has several points and no children.
  void complete();

 private:
  double farthest2(const PointTree::Node& node, Vec3 from) const;
  Vec3 middle(const PointTree::Node& node) const;
  std::size_t nearest(const PointTree::Node& node, Vec3 to) const;
  void measure(PointTree::Node& node) const;
  void split(std::size_t k);
  void choose_centers(const PointTree::Node& node);
  void sort_by_center(const PointTree::Node& node);
  const Vec3* points_of(const PointTree::Node& node) const { return wrapped_.data() + node.first_point; }

  const Box& box_;
  double base_radius_;
  std::vector<PointTree::Node>& nodes_;
  std::vector<std::int32_t>& ids_;
  std::vector<Vec3> wrapped_;  ///< by place in ids_

  // Of the node that is split
  std::vector<std::int32_t> parts_;      ///< how many points its children get
  std::vector<std::int32_t> center_of_;  ///< by point: the number of its center
  std::vector<double> distance2_;        ///< by point: from its center [length^2]
  std::vector<std::int32_t> next_, sorted_ids_;
  std::vector<Vec3> sorted_;
};

}  // namespace dch::detail
