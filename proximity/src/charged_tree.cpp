// SPDX-License-Identifier: MIT
#include "charged_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

/// Of a node without children; expansions of smaller ones cost more than the pairs that they save.
constexpr std::int32_t kMostPoints = 64;

/// Of squares of shorter distances, and the inverses of these, little would be left.
constexpr double kNearest = 1e-140;

/// The image of `p` nearest to `anchor`; p itself, to the last bit, if it is that.
Vec3 image_near(const Box& box, Vec3 anchor, Vec3 p) {
  const Vec3 from_anchor = p - anchor;
  return p + (box.nearest_image(from_anchor) - from_anchor);
}

}  // namespace

ChargedTree::ChargedTree(const PointTree& tree, Span<const double> charges, int power)
    : at_(tree.size()), charges_(tree.size()), weights_(tree.size()) {
  if (tree.size() == 0) return;
  const double radius = tree.node(0).radius;
  if (radius > 0) unit_ = std::ldexp(1.0, std::ilogb(radius));
  const double nearest = std::max(kNearest, tree.rounding() / unit_);
  least2_ = nearest * nearest;
  for (std::size_t k = 0; k < charges_.size(); ++k) {
    charges_[k] = charges[static_cast<std::size_t>(tree.ids()[k])];
    weights_[k] = std::abs(charges_[k]);
  }
  take(tree);
  for (ChargedNode& node : nodes_) measure(node, power);
}

void ChargedTree::take(const PointTree& tree) {
  struct Taken {
    std::int32_t node;
    Vec3 anchor;  ///< its center, in the image of its parent
  };
  std::vector<Taken> taken{{0, tree.node(0).center}};
  for (std::size_t k = 0; k < taken.size(); ++k) {
    const Taken of = taken[k];
    const PointTree::Node& node = tree.node(of.node);
    ChargedNode charged;
    charged.first = node.first_point;
    charged.points = charged.charges = node.points;
    if (node.points <= kMostPoints || node.radius == 0) {
      place_points(tree, node, of.anchor);
      if (node.radius == 0) charged.charges = 1;
    } else {
      charged.first_child = static_cast<std::int32_t>(taken.size());
      charged.children = node.children;
      for (std::int32_t child = node.first_child; child < node.first_child + node.children; ++child)
        taken.push_back({child, image_near(tree.box(), of.anchor, tree.node(child).center)});
    }
    nodes_.push_back(charged);
  }
}

void ChargedTree::place_points(const PointTree& tree, const PointTree::Node& node, Vec3 anchor) {
  const auto first = static_cast<std::size_t>(node.first_point);
  const std::size_t end = first + static_cast<std::size_t>(node.points);
  for (std::size_t k = first; k < end; ++k)
    at_[k] = (1 / unit_) * image_near(tree.box(), anchor, tree.box().wrap(tree.position(tree.ids()[k])));
  if (node.radius > 0) return;
  for (std::size_t k = first + 1; k < end; ++k) {
    at_[k] = at_[first];
    charges_[first] += std::exchange(charges_[k], 0.0);
    weights_[first] += std::exchange(weights_[k], 0.0);
  }
}

void ChargedTree::measure(ChargedNode& node, int power) const {
  const auto first = static_cast<std::size_t>(node.first),
             end = first + static_cast<std::size_t>(node.points);
  for (std::size_t k = first; k < end; ++k) node.weight += weights_[k];
  Vec3 sum;
  for (std::size_t k = first; k < end && node.weight > 0; ++k)
    sum = sum + (weights_[k] / node.weight) * (at_[k] - at_[first]);
  node.center = at_[first] + sum;
  double farthest2 = 0;
  for (std::size_t k = first; k < end; ++k) farthest2 = std::max(farthest2, norm2(at_[k] - node.center));
  if (farthest2 == 0) return;
  node.radius = std::sqrt(farthest2) * kInflate;
  double mean = 0;
  for (std::size_t k = first; k < end && node.weight > 0; ++k) {
    const double share = weights_[k] / node.weight, distance2 = norm2(at_[k] - node.center);
    const double relative = std::sqrt(distance2) / node.radius;
    node.spread2 += share * distance2;
    double term = share;
    for (int n = 0; n < power; ++n) term *= relative;
    mean += term;
  }
  node.spread2 *= kInflate;
  node.reach = node.radius * std::min(1.0, std::pow(mean, 1.0 / power) * kInflate);
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
