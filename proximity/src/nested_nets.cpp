// SPDX-License-Identifier: MIT
#include "nested_nets.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "discrete_centers.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {

NestedNets::NestedNets(const Box& box, double base_radius, const std::vector<Vec3>& positions, NewTree& tree)
    : box_(box), base_radius_(base_radius), tree_(tree) {
  for (const std::int32_t id : tree.ids)
    wrapped_.push_back(box.wrap(positions[static_cast<std::size_t>(id)]));
}

/// The net of a node that a hierarchy has reaches as far as its points are apart, like that of any other.
void NestedNets::complete() {
  // Nodes that a split adds stand at the end, so they get their turn.
  for (std::size_t k = 0; k < tree_.nodes.size(); ++k) {
    PointTree::Node& node = tree_.nodes[k];
    const PointsOfNode points = points_of(k);
    if (node.points == 1) {
      node.center = points.at[0];
      node.representative = points.ids[0];
      continue;
    }
    measure_ball(box_, points, node);
    const double radius = node.reach > 0 ? center_radius_below(node.reach / kInflate, base_radius_) : 0;
    tree_.nets[k].radius = std::max(tree_.nets[k].radius, radius);
    if (node.children == 0) split(k);
  }
}

PointsOfNode NestedNets::points_of(std::size_t k) const {
  const auto first = static_cast<std::size_t>(tree_.first_point[k]);
  const auto points = static_cast<std::size_t>(tree_.nodes[k].points);
  return {{wrapped_.data() + first, points}, {tree_.ids.data() + first, points}};
}

void NestedNets::split(std::size_t k) {
  const PointTree::Node node = tree_.nodes[k];
  if (node.reach > 0) {
    choose_centers(k);
    sort_by_center(k);
  } else {
    // Points that coincide are halved: no more nodes than other points take, and no deeper.
    parts_ = {node.points / 2, node.points - node.points / 2};
    sites_ = {node.center, node.center};
  }
  tree_.begin_row(k, parts_.size());
  std::int32_t place = tree_.first_point[k];
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    tree_.add(k, place, parts_[part], sites_[part]);
    place += parts_[part];
  }
}

/// Greedy, with the representative first: a point that no center covers becomes one. The reach is that of the
/// representative and no other point, so the representative does not cover the farthest one.
void NestedNets::choose_centers(std::size_t k) {
  const double radius = tree_.nets[k].radius;
  const PointsOfNode points = points_of(k);
  center_of_.assign(points.at.size(), 0);
  distance2_.assign(points.at.size(), std::numeric_limits<double>::infinity());
  parts_.clear();
  sites_.clear();
  const auto add = [&](Vec3 center) {
    for (std::size_t p = 0; p < points.at.size(); ++p) {
      const double d2 = box_.distance2(center, points.at[p]);
      if (d2 >= distance2_[p]) continue;
      distance2_[p] = d2;
      center_of_[p] = static_cast<std::int32_t>(parts_.size());
    }
    parts_.push_back(0);
    sites_.push_back(center);
  };
  add(points.at[static_cast<std::size_t>(
      std::find(points.ids.begin(), points.ids.end(), tree_.nodes[k].representative) - points.ids.begin())]);
  for (std::size_t p = 0; p < points.at.size(); ++p)
    if (distance2_[p] > radius * radius) add(points.at[p]);
  assert(parts_.size() > 1);
}

void NestedNets::sort_by_center(std::size_t k) {
  for (const std::int32_t center : center_of_) ++parts_[static_cast<std::size_t>(center)];
  next_.assign(parts_.size(), 0);
  for (std::size_t c = 1; c < parts_.size(); ++c) next_[c] = next_[c - 1] + parts_[c - 1];
  sorted_ids_.resize(center_of_.size());
  sorted_.resize(center_of_.size());
  const auto ids = tree_.ids.begin() + tree_.first_point[k];
  const auto points = wrapped_.begin() + tree_.first_point[k];
  for (std::size_t p = 0; p < center_of_.size(); ++p) {
    const auto to = static_cast<std::size_t>(next_[static_cast<std::size_t>(center_of_[p])]++);
    sorted_ids_[to] = ids[static_cast<std::ptrdiff_t>(p)];
    sorted_[to] = points[static_cast<std::ptrdiff_t>(p)];
  }
  std::copy(sorted_ids_.begin(), sorted_ids_.end(), ids);
  std::copy(sorted_.begin(), sorted_.end(), points);
}

}  // namespace dch::detail
