// SPDX-License-Identifier: MIT
#include "far_descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dch::detail {
namespace {

/// Sums below this part of what is known already are left out of lower bounds.
constexpr double kNegligible = 1e-3;

Vec3 displacement(const ChargedNode& target, const ChargedNode& source, Vec3 image) {
  return target.center - source.center - image;
}

/// Adds what the charges below a node contribute at least at the points of a target at the bottom.
class LeastPotential {
 public:
  LeastPotential(const ChargedTree& tree, const Truncation& truncation, const ChargedNode& target)
      : tree_(tree), truncation_(truncation), target_(target) {}

  double sum() const { return sum_; }

  void add(std::int32_t source, Vec3 image) {
    const ChargedNode& node = tree_.node(source);
    if (&node == &target_ && image == Vec3{}) {
      sum_ += of_itself();
      return;
    }
    const double apart = std::sqrt(norm2(displacement(target_, node, image)));
    if (node.is_bottom() || node.radius <= 0.5 * apart) {
      sum_ += truncation_.least(node, apart, target_.radius);
      return;
    }
    const double nearest = apart - node.radius;
    if (nearest > 0 && node.weight * truncation_.kernel(nearest) < kNegligible * sum_) return;
    for (std::int32_t k = 0; k < node.children; ++k) add(node.first_child + k, image);
  }

 private:
  /// At its points by its own charges, pair by pair: kernels may fall steeply within a node.
  double of_itself() const {
    double least = std::numeric_limits<double>::infinity();
    const std::int32_t end = target_.first + target_.charges;
    for (std::int32_t at = target_.first; at < end; ++at) {
      double sum = 0;
      for (std::int32_t other = target_.first; other < end; ++other) {
        const double distance2 = norm2(tree_.at(other) - tree_.at(at));
        if (distance2 > tree_.least2())
          sum += std::abs(tree_.charge(other)) * truncation_.kernel(std::sqrt(distance2));
      }
      least = std::min(least, sum);
    }
    return least;
  }

  const ChargedTree& tree_;
  const Truncation& truncation_;
  const ChargedNode& target_;
  double sum_ = 0;
};

}  // namespace

std::vector<SumSource> root_sources(const SumScene& scene) {
  std::vector<SumSource> roots(scene.images.size());
  for (std::size_t k = 0; k < roots.size(); ++k) roots[k].image = static_cast<std::int32_t>(k);
  return roots;
}

std::vector<double> least_potentials(const ChargedTree& tree, const std::vector<Vec3>& images,
                                     const Truncation& truncation) {
  // Images that are far for the size of the whole are taken once for all points; there may be very many.
  const ChargedNode& root = tree.node(0);
  std::vector<Vec3> near;
  double by_far_images = 0;
  for (const Vec3 image : images) {
    const double apart = std::sqrt(norm2(image));
    if (apart > 3 * root.radius) {
      by_far_images += truncation.least(root, apart, root.radius);
    } else {
      near.push_back(image);
    }
  }
  std::vector<double> least(tree.nodes().size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = least.size(); k-- > 0;) {  // children before their parents
    const ChargedNode& node = tree.nodes()[k];
    for (std::int32_t child = node.first_child; child < node.first_child + node.children; ++child)
      least[k] = std::min(least[k], least[static_cast<std::size_t>(child)]);
    if (!node.is_bottom()) continue;
    LeastPotential potential(tree, truncation, node);
    for (const Vec3 image : near) potential.add(0, image);
    least[k] = potential.sum() + by_far_images;
  }
  return least;
}

void take_sources(const SumScene& scene, std::int32_t target, Span<const SumSource> sources, double& error,
                  Interactions& result) {
  result.far.clear();
  result.near.clear();
  result.rest.clear();
  const ChargedNode& at = scene.tree.node(target);
  const double least = scene.least[static_cast<std::size_t>(target)];
  std::vector<SumSource>& waiting = result.waiting;
  waiting.assign(sources.begin(), sources.end());
  while (!waiting.empty()) {
    const SumSource source = waiting.back();
    waiting.pop_back();
    const ChargedNode& node = scene.tree.node(source.node);
    if (node.weight == 0) continue;
    ++result.looked_at;
    const Vec3 from = displacement(at, node, scene.images[static_cast<std::size_t>(source.image)]);
    const double apart = std::sqrt(norm2(from));
    const Expanded by = scene.truncation.lowest_order(
        node, apart, at.radius, std::min(scene.share * least, scene.most * least - error));
    if (by.is_far) {
      error += by.error;
      if (by.order >= 0) result.far.push_back({source, from, apart, by.order});
    } else if (!node.is_bottom() && (at.is_bottom() || node.radius >= at.radius)) {
      for (std::int32_t k = 0; k < node.children; ++k)
        waiting.push_back({node.first_child + k, source.image});
    } else {
      (at.is_bottom() ? result.near : result.rest).push_back(source);
    }
  }
}

}  // namespace dch::detail
