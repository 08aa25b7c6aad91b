// SPDX-License-Identifier: MIT
#include "nested_nets.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "discrete_centers.hpp"
#include "geometry/tolerance.hpp"

namespace dch::detail {

NestedNets::NestedNets(const Box& box, double base_radius, const std::vector<Vec3>& positions,
                       std::vector<PointTree::Node>& nodes, std::vector<std::int32_t>& ids)
    : box_(box), base_radius_(base_radius), nodes_(nodes), ids_(ids) {
  for (const std::int32_t id : ids) wrapped_.push_back(box.wrap(positions[static_cast<std::size_t>(id)]));
}

void NestedNets::complete() {
  // Nodes that a split adds stand at the end, so they get their turn.
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    measure(nodes_[k]);
    if (nodes_[k].points > 1 && nodes_[k].children == 0) split(k);
  }
}

double NestedNets::farthest2(const PointTree::Node& node, Vec3 from) const {
  double most = 0;
  for (std::int32_t p = 0; p < node.points; ++p)
    most = std::max(most, box_.distance2(from, points_of(node)[p]));
  return most;
}

/// Center of the box around the points, as seen from the first of them. In a periodic box as small as the
/// node that may be a poor center, but the radius is measured from it all the same.
Vec3 NestedNets::middle(const PointTree::Node& node) const {
  const Vec3* const at = points_of(node);
  Vec3 low, high;
  for (std::int32_t p = 1; p < node.points; ++p) {
    const Vec3 d = box_.nearest_image(at[p] - at[0]);
    low = {std::min(low.x, d.x), std::min(low.y, d.y), std::min(low.z, d.z)};
    high = {std::max(high.x, d.x), std::max(high.y, d.y), std::max(high.z, d.z)};
  }
  return box_.wrap(at[0] + 0.5 * (low + high));
}

/// The place of a node's point, the first of several.
std::size_t NestedNets::nearest(const PointTree::Node& node, Vec3 to) const {
  auto best = static_cast<std::size_t>(node.first_point);
  double least = std::numeric_limits<double>::infinity();
  const std::size_t end = best + static_cast<std::size_t>(node.points);
  for (std::size_t place = best; place < end; ++place) {
    const double d2 = box_.distance2(to, wrapped_[place]);
    if (d2 >= least) continue;
    best = place;
    least = d2;
  }
  return best;
}

void NestedNets::measure(PointTree::Node& node) const {
  node.center = middle(node);
  const std::size_t place = nearest(node, node.center);
  node.representative = ids_[place];
  node.radius = std::sqrt(farthest2(node, node.center)) * kInflate;
  node.reach = std::sqrt(farthest2(node, wrapped_[place])) * kInflate;
  // Points that coincide have no radius, though rounding may put their middle beside them.
  if (node.radius > 0 && node.radius < node.reach) return;
  node.center = wrapped_[place];
  node.radius = node.reach;
}

void NestedNets::split(std::size_t k) {
  const PointTree::Node node = nodes_[k];
  if (node.reach > 0) {
    choose_centers(node);
    sort_by_center(node);
  } else {
    // Points that coincide are halved: no more nodes than other points take, and no deeper.
    parts_ = {node.points / 2, node.points - node.points / 2};
  }
  nodes_[k].first_child = static_cast<std::int32_t>(nodes_.size());
  nodes_[k].children = static_cast<std::int32_t>(parts_.size());
  PointTree::Node child;
  child.first_point = node.first_point;
  for (const std::int32_t points : parts_) {
    child.points = points;
    nodes_.push_back(child);
    child.first_point += points;
  }
}

/// Greedy, with the representative first: a point that no center covers becomes one. The reach is that of the
/// representative and no other point, so the representative does not cover the farthest one.
void NestedNets::choose_centers(const PointTree::Node& node) {
  const double radius = center_radius_below(node.reach / kInflate, base_radius_);
  const Vec3* const at = points_of(node);
  const auto count = static_cast<std::size_t>(node.points);
  center_of_.assign(count, 0);
  distance2_.assign(count, std::numeric_limits<double>::infinity());
  parts_.clear();
  const auto add = [&](Vec3 center) {
    for (std::size_t p = 0; p < count; ++p) {
      const double d2 = box_.distance2(center, at[p]);
      if (d2 >= distance2_[p]) continue;
      distance2_[p] = d2;
      center_of_[p] = static_cast<std::int32_t>(parts_.size());
    }
    parts_.push_back(0);
  };
  const auto ids = ids_.begin() + node.first_point;
  add(at[std::find(ids, ids + node.points, node.representative) - ids]);
  for (std::size_t p = 0; p < count; ++p)
    if (distance2_[p] > radius * radius) add(at[p]);
  assert(parts_.size() > 1);
}

void NestedNets::sort_by_center(const PointTree::Node& node) {
  for (const std::int32_t center : center_of_) ++parts_[static_cast<std::size_t>(center)];
  next_.assign(parts_.size(), 0);
  for (std::size_t c = 1; c < parts_.size(); ++c) next_[c] = next_[c - 1] + parts_[c - 1];
  sorted_ids_.resize(center_of_.size());
  sorted_.resize(center_of_.size());
  const auto ids = ids_.begin() + node.first_point;
  const auto points = wrapped_.begin() + node.first_point;
  for (std::size_t p = 0; p < center_of_.size(); ++p) {
    const auto to = static_cast<std::size_t>(next_[static_cast<std::size_t>(center_of_[p])]++);
    sorted_ids_[to] = ids[static_cast<std::ptrdiff_t>(p)];
    sorted_[to] = points[static_cast<std::ptrdiff_t>(p)];
  }
  std::copy(sorted_ids_.begin(), sorted_ids_.end(), ids);
  std::copy(sorted_.begin(), sorted_.end(), points);
}

}  // namespace dch::detail
