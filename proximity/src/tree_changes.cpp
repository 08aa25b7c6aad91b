// SPDX-License-Identifier: MIT
#include "tree_changes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "discrete_centers.hpp"
#include "geometry/tolerance.hpp"
#include "hierarchy/structure.hpp"
#include "measured_ball.hpp"

namespace dch::detail {
namespace {

/// A ball is measured anew after this share of its points has changed.
constexpr std::int32_t kShareOfChanges = 2;
/// And after its points have moved by this share of its radius.
constexpr double kShareOfRadius = 16;
/// Points that move need another place where they are farther from their site than this many radii of the
/// net.
constexpr double kStray = 1 + 1 / kShareOfRadius;

}  // namespace

double TreeChanges::distance(Vec3 a, Vec3 b) const { return std::sqrt(tree_.box_.distance2(a, b)); }

Vec3 TreeChanges::place_now(std::int32_t id) const {
  return tree_.box_.wrap(structure_.raw[static_cast<std::size_t>(id)]);
}

void TreeChanges::insert(std::int32_t id) {
  ++tree_.work_.placed;
  const Vec3 at = place_now(id);
  tree_.positions_[static_cast<std::size_t>(id)] = structure_.raw[static_cast<std::size_t>(id)];
  const std::int32_t parent = place_for(at);
  const std::int32_t leaf = rows_.append(parent);
  add_leaf(leaf, id, at);
  for (std::int32_t k = parent; k >= 0; k = node(k).parent) {
    ++tree_.work_.nodes;
    ++node(k).points;
    grow(k, at);
    note_change(k);
  }
}

void TreeChanges::add_leaf(std::int32_t k, std::int32_t id, Vec3 at) {
  node(k).center = net(k).site = at;
  node(k).representative = id;
  node(k).points = 1;
  tree_.node_of_[static_cast<std::size_t>(id)] = k;
}

/// The node that a point becomes a child of.
std::int32_t TreeChanges::place_for(Vec3 at) {
  for (std::int32_t k = 0;;) {
    const PointTree::Node& here = node(k);
    const double apart = distance(at, here.center);
    const double radius = apart > 0 ? center_radius_below(apart, tree_.base_radius_) : 0;
    const bool is_far = apart > 0 && radius >= 2 * net(k).radius && radius >= here.radius;
    if (here.children == 0 || is_far) {
      put_above(k, at, apart);
      net(k).radius = radius;
      return k;
    }
    if (net(k).radius == 0 && here.radius == 0) {
      k = smallest_child(k);  // points that coincide
      continue;
    }
    double from_site = 0;
    const std::int32_t child = nearest_child(k, at, from_site);
    if (from_site > net(k).radius) return k;
    k = child;
  }
}

std::int32_t TreeChanges::nearest_child(std::int32_t k, Vec3 at, double& apart) {
  const std::int32_t first = node(k).first_child, end = first + node(k).children;
  std::int32_t best = first;
  double least2 = std::numeric_limits<double>::infinity();
  tree_.work_.nodes += end - first;
  for (std::int32_t child = first; child < end; ++child) {
    const double d2 = tree_.box_.distance2(net(child).site, at);
    if (d2 >= least2) continue;
    least2 = d2;
    best = child;
  }
  apart = std::sqrt(least2);
  return best;
}

std::int32_t TreeChanges::smallest_child(std::int32_t k) {
  std::int32_t best = node(k).first_child;
  for (std::int32_t child = best; child < node(k).first_child + node(k).children; ++child)
    if (node(child).points < node(best).points) best = child;
  return best;
}

/// Puts a node above another one, for a point that is farther away than the net of that one reaches. Its net
/// has the center of the ball for a site, all of which it covers.
void TreeChanges::put_above(std::int32_t k, Vec3 at, double apart) {
  const std::int32_t child = rows_.push_down(k);
  const Vec3 center = node(child).center;
  const double radius = node(child).radius;
  net(child).site = center;
  if (apart <= radius) return;
  const Vec3 towards = tree_.box_.nearest_image(at - center);
  PointTree::Node& above = node(k);
  above.center = tree_.box_.wrap(center + (0.5 * (apart - radius) / apart) * towards);
  above.radius = (distance(above.center, center) + radius + tree_.rounding_) * kInflate;
}

void TreeChanges::remove(std::int32_t id) {
  ++tree_.work_.placed;
  const std::int32_t leaf = std::exchange(tree_.node_of_[static_cast<std::size_t>(id)], -1);
  std::int32_t k = node(leaf).parent;
  rows_.erase(leaf);
  if (node(k).children == 1) {
    rows_.pull_up(k);
    k = node(k).parent;
  }
  for (; k >= 0; k = node(k).parent) {
    ++tree_.work_.nodes;
    --node(k).points;
    if (node(k).representative == id) choose_representative(k);
    note_change(k);
  }
}

/// That of the child whose is nearest to the center.
void TreeChanges::choose_representative(std::int32_t k) {
  PointTree::Node& here = node(k);
  double least = std::numeric_limits<double>::infinity();
  tree_.work_.nodes += here.children;
  for (std::int32_t child = here.first_child; child < here.first_child + here.children; ++child) {
    const std::int32_t id = node(child).representative;
    const double apart = distance(here.center, center_of(id));
    if (apart >= least) continue;
    least = apart;
    here.representative = id;
  }
  here.reach = here.radius > 0 ? (least + here.radius + tree_.rounding_) * kInflate : 0;
}

Vec3 TreeChanges::center_of(std::int32_t id) {
  return node(tree_.node_of_[static_cast<std::size_t>(id)]).center;
}

void TreeChanges::grow(std::int32_t k, Vec3 at) {
  PointTree::Node& here = node(k);
  here.radius = std::max(here.radius, distance(here.center, at) * kInflate);
  here.reach = std::max(here.reach, distance(center_of(here.representative), at) * kInflate);
}

void TreeChanges::note_change(std::int32_t k) {
  const bool has_rounded = (node(k).radius > 0) != (node(k).reach > 0);
  if (kShareOfChanges * ++net(k).changes >= node(k).points || has_rounded) measure(k);
}

void TreeChanges::measure(std::int32_t k) {
  at_.clear();
  ids_.clear();
  const PointTree::PointsBelow below = tree_.points_below(node(k));
  for (auto point = below.begin(); point != below.end(); ++point) {
    at_.push_back(point.node().center);
    ids_.push_back(*point);
  }
  tree_.work_.measured += node(k).points;
  measure_ball_again(tree_.box_, {at_, ids_}, node(k));
  net(k).changes = 0;
}

/// Whether a point is to leave its node. It is looked at by the last net alone: nets above are so much wider
/// that what this one lets pass is little to them.
bool TreeChanges::strays(std::int32_t leaf, Vec3 at) {
  const std::int32_t parent = node(leaf).parent;
  return parent >= 0 && distance(net(leaf).site, at) > kStray * net(parent).radius;
}

std::vector<std::int32_t> TreeChanges::move(const std::vector<std::int32_t>& moved, bool at_once) {
  strayed_.clear();
  if (at_once) {
    move_below(0);
  } else {
    for (const std::int32_t id : moved) move_alone(id);
  }
  std::sort(strayed_.begin(), strayed_.end());
  return strayed_;
}

void TreeChanges::move_alone(std::int32_t id) {
  const std::int32_t leaf = tree_.node_of_[static_cast<std::size_t>(id)];
  const Vec3 at = place_now(id);
  if (strays(leaf, at)) return strayed_.push_back(id);
  const double step = distance(node(leaf).center, at);
  node(leaf).center = at;
  tree_.positions_[static_cast<std::size_t>(id)] = structure_.raw[static_cast<std::size_t>(id)];
  for (std::int32_t k = node(leaf).parent; k >= 0; k = node(k).parent) {
    ++tree_.work_.nodes;
    if (node(k).representative == id) node(k).reach = (node(k).reach + step + tree_.rounding_) * kInflate;
    grow(k, at);
    note_change(k);
  }
}

/// Returns how far a point below has moved at most. A ball grows by that, the distance from a representative,
/// which may have moved too, by twice as much.
double TreeChanges::move_below(std::int32_t k) {
  if (node(k).children == 0) return move_leaf(k);
  ++tree_.work_.nodes;
  double farthest = 0;
  const std::int32_t first = node(k).first_child, end = first + node(k).children;
  ask_for_places(first, end);
  for (std::int32_t child = first; child < end; ++child) farthest = std::max(farthest, move_below(child));
  if (farthest == 0) return 0;
  PointTree::Node& here = node(k);
  const double step = farthest + tree_.rounding_;
  here.radius = (here.radius + step) * kInflate;
  here.reach = (here.reach + 2 * step) * kInflate;
  double& moved = net(k).moved;
  moved += step;
  if (kShareOfRadius * moved > here.radius - moved) {
    measure(k);
    moved = 0;
  }
  return farthest;
}

/// Has the places of the points of nodes fetched, which lie anywhere.
void TreeChanges::ask_for_places(std::int32_t first, std::int32_t end) {
  for (std::int32_t k = first; k < end; ++k) {
    const auto id = static_cast<std::size_t>(node(k).representative);
    __builtin_prefetch(tree_.positions_.data() + id);
    __builtin_prefetch(structure_.raw.data() + id);
  }
}

double TreeChanges::move_leaf(std::int32_t k) {
  PointTree::Node& leaf = node(k);
  Vec3& before = tree_.positions_[static_cast<std::size_t>(leaf.representative)];
  const Vec3 given = structure_.raw[static_cast<std::size_t>(leaf.representative)];
  if (before == given) return 0;
  const Vec3 at = tree_.box_.wrap(given);
  if (strays(k, at)) {
    strayed_.push_back(leaf.representative);
    return 0;
  }
  const double step = distance(leaf.center, at) * kInflate;
  leaf.center = at;
  before = given;
  return step;
}

}  // namespace dch::detail
