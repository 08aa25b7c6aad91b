// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/proximity/point_tree.hpp>

#include "measured_ball.hpp"
#include "new_tree.hpp"

namespace dch::detail {

/// Measures the balls of a tree of points, and makes the nodes inside its leaves.
class NestedNets {
 public:
  /// @param positions by id, as given
  NestedNets(const Box& box, double base_radius, const std::vector<Vec3>& positions, NewTree& tree);

  /// Goes on below each node that has several points and no children.
  void complete();

 private:
  PointsOfNode points_of(std::size_t k) const;
  void split(std::size_t k);
  void choose_centers(std::size_t k);
  void sort_by_center(std::size_t k);

  const Box& box_;
  double base_radius_;
  NewTree& tree_;
  std::vector<Vec3> wrapped_;  ///< by place in the ids of the tree

  // Of the node that is split
  std::vector<std::int32_t> parts_;      ///< how many points its children get
  std::vector<Vec3> sites_;              ///< the centers
  std::vector<std::int32_t> center_of_;  ///< by point: the number of its center
  std::vector<double> distance2_;        ///< by point: from its center [length^2]
  std::vector<std::int32_t> next_, sorted_ids_;
  std::vector<Vec3> sorted_;
};

}  // namespace dch::detail
