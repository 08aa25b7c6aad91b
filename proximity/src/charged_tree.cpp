// SPDX-License-Identifier: MIT
#include "charged_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

/// Of a node without children; expansions of smaller ones cost more than the pairs that they save.
constexpr std::int32_t kMaxPoints = 32;

/// A point far from all others halves a node unevenly. Nodes deeper than that are halved by number.
constexpr int kMaxDepth = 64;

/// Of squares of shorter distances, and the inverses of these, little would be left.
constexpr double kNearest = 1e-140;

/// The image of `p` nearest to `anchor`; p itself, to the last bit, if it is that.
Vec3 image_near(const Box& box, Vec3 anchor, Vec3 p) {
  const Vec3 from_anchor = p - anchor;
  return p + (box.nearest_image(from_anchor) - from_anchor);
}

}  // namespace

ChargedTree::ChargedTree(const PointTree& tree, Span<const double> charges, int degree) {
  if (tree.size() == 0) return;
  const double radius = tree.node(0).radius;
  if (radius > 0) unit_ = std::ldexp(1.0, std::ilogb(radius));
  const double nearest = std::max(kNearest, tree.rounding() / unit_);
  least2_ = nearest * nearest;
  place_charges(tree, charges);
  split();
  MeasureMoments moments(degree);
  for (ChargedNode& node : nodes_) {
    measure(node, degree + 1);
    measure_moments(node, moments);
  }
}

void ChargedTree::place_charges(const PointTree& tree, Span<const double> charges) {
  charges_.reserve(tree.size());
  for (const std::int32_t id : tree.ids()) {
    const double charge = charges[static_cast<std::size_t>(id)];
    const Vec3 at = image_near(tree.box(), tree.node(0).center, tree.box().wrap(tree.position(id)));
    charges_.push_back({(1 / unit_) * at, charge, std::abs(charge), id});
  }
}

void ChargedTree::split() {
  ChargedNode root;
  root.points = root.charges = static_cast<std::int32_t>(charges_.size());
  nodes_.push_back(root);
  std::vector<int> depth{0};
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    ChargedNode& node = nodes_[k];
    Vec3 low = at(node.first), high = low;
    for (std::int32_t place = node.first; place < node.first + node.points; ++place)
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], at(place)[axis]);
        high[axis] = std::max(high[axis], at(place)[axis]);
      }
    if (low == high) join(node);
    if (low == high || node.points <= kMaxPoints) continue;
    ChargedNode first, second;
    first.first = node.first;
    first.points = first.charges = halve(node, low, high, depth[k] < kMaxDepth);
    second.first = node.first + first.points;
    second.points = second.charges = node.points - first.points;
    node.first_child = static_cast<std::int32_t>(nodes_.size());
    node.children = 2;
    nodes_.push_back(first);  // `node` is no more
    nodes_.push_back(second);
    depth.insert(depth.end(), 2, depth[k] + 1);
  }
}

/// Puts the points of one half in front of the others and returns their number.
std::int32_t ChargedTree::halve(const ChargedNode& node, Vec3 low, Vec3 high, bool by_length) {
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (high[other] - low[other] > high[axis] - low[axis]) axis = other;
  const double middle = 0.5 * low[axis] + 0.5 * high[axis];
  const auto begin = charges_.begin() + node.first, end = begin + node.points;
  if (by_length && middle > low[axis])
    return static_cast<std::int32_t>(
        std::partition(begin, end, [&](const Charge& c) { return c.at[axis] < middle; }) - begin);
  const std::int32_t half = node.points / 2;
  std::nth_element(begin, begin + half, end, [&](const Charge& a, const Charge& b) {
    return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.id < b.id;
  });
  return half;
}

/// Of points that coincide the first one has all charge.
void ChargedTree::join(ChargedNode& node) {
  node.charges = 1;
  Charge& first = charges_[static_cast<std::size_t>(node.first)];
  for (std::int32_t place = node.first + 1; place < node.first + node.points; ++place) {
    Charge& other = charges_[static_cast<std::size_t>(place)];
    first.charge += std::exchange(other.charge, 0.0);
    first.weight += std::exchange(other.weight, 0.0);
  }
}

void ChargedTree::measure(ChargedNode& node, int power) const {
  const auto begin = charges_.begin() + node.first, end = begin + node.points;
  for (auto c = begin; c != end; ++c) node.weight += c->weight;
  Vec3 sum;
  for (auto c = begin; c != end && node.weight > 0; ++c)
    sum = sum + (c->weight / node.weight) * (c->at - begin->at);
  node.center = begin->at + sum;
  double farthest2 = 0;
  for (auto c = begin; c != end; ++c) farthest2 = std::max(farthest2, norm2(c->at - node.center));
  if (farthest2 == 0) return;
  node.radius = std::sqrt(farthest2) * kInflate;
  double mean = 0;
  for (auto c = begin; c != end && node.weight > 0; ++c) {
    const double share = c->weight / node.weight, distance2 = norm2(c->at - node.center);
    const double relative = std::sqrt(distance2) / node.radius;
    node.spread2 += share * distance2;
    double term = share;
    for (int n = 0; n < power; ++n) term *= relative;
    mean += term;
  }
  node.spread2 *= kInflate;
  node.reach = node.radius * std::min(1.0, std::pow(mean, 1.0 / power) * kInflate);
}

void ChargedTree::measure_moments(ChargedNode& node, MeasureMoments& moments) const {
  if (node.weight == 0) return;
  moments.clear();
  const double of_radius = node.radius > 0 ? 1 / node.radius : 0;
  for (std::int32_t place = node.first; place < node.first + node.charges; ++place)
    moments.add(charge(place) / node.weight, of_radius * (at(place) - node.center));
  node.moments = moments.sizes(1);
}

std::vector<double> multipoles_of(const ChargedTree& tree, const Expansions& expansions) {
  const std::size_t size = expansions.size(), short_size = expansions.short_size();
  std::vector<double> whole(tree.nodes().size() * size), result(tree.nodes().size() * short_size);
  for (std::size_t k = tree.nodes().size(); k-- > 0;) {  // children before their parents
    const ChargedNode& node = tree.nodes()[k];
    const double inverse = node.radius > 0 ? 1 / node.radius : 0;
    double* const moments = whole.data() + k * size;
    if (node.is_bottom())
      for (std::int32_t place = node.first; place < node.first + node.charges; ++place)
        expansions.add_charge(tree.charge(place), inverse * (tree.at(place) - node.center), moments);
    for (std::int32_t child = node.first_child; child < node.first_child + node.children; ++child) {
      const ChargedNode& below = tree.node(child);
      expansions.add_child(whole.data() + static_cast<std::size_t>(child) * size,
                           inverse * (node.center - below.center), inverse * below.radius, moments);
    }
    expansions.shorten(moments, result.data() + k * short_size);
  }
  return result;
}

}  // namespace dch::detail
