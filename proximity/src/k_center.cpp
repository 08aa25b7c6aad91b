// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <dch/base/error.hpp>
#include <dch/proximity/k_center.hpp>

#include "covering_radius.hpp"
#include "discrete_centers.hpp"
#include "geometry/tolerance.hpp"

namespace dch {
namespace {

/// Nested nets of a tree's points.
class Nets {
 public:
  Nets(const PointTree& tree, std::size_t most)
      : tree_(tree), most_(most), is_covered_(tree.nodes().size()) {}

  /// Adds centers, so that all points are within a distance of one, and all centers farther apart; or only
  /// until there are as many as asked for.
  void refine(double radius) {
    radius_ = radius;
    is_covered_.assign(is_covered_.size(), false);
    for (const std::int32_t center : centers) cover(tree_.position(center));
    path_.assign(1, {0, 0});
    while (!path_.empty() && centers.size() < most_) {
      Visit& last = path_.back();
      const PointTree::Node& node = tree_.node(last.node);
      if (is_covered(last.node) || (node.points > 1 && last.next_child == node.children)) {
        path_.pop_back();
      } else if (node.points > 1) {
        const std::int32_t child = node.first_child + last.next_child++;
        path_.push_back({child, 0});
      } else {
        centers.push_back(node.representative);
        cover(tree_.position(node.representative));
        // What is below a node that is covered as a whole bears no mark.
        path_.erase(std::find_if(path_.begin(), path_.end(),
                                 [&](const Visit& visit) { return is_covered(visit.node); }),
                    path_.end());
      }
    }
  }

  std::vector<std::int32_t> centers;
  std::int64_t looked_at = 0;  ///< distances of centers from nodes

 private:
  struct Visit {
    std::int32_t node, next_child;
  };
  bool is_covered(std::int32_t node) const { return is_covered_[static_cast<std::size_t>(node)]; }
  /// Marks nodes with all points within the radius of a place.
  void cover(Vec3 at) {
    covering_.assign(1, 0);
    while (!covering_.empty()) {
      const std::int32_t k = covering_.back();
      covering_.pop_back();
      if (is_covered(k)) continue;
      ++looked_at;
      const PointTree::Node& node = tree_.node(k);
      if (node.points == 1) {
        is_covered_[static_cast<std::size_t>(k)] =
            tree_.box().distance2(at, tree_.position(node.representative)) <= radius_ * radius_;
        continue;
      }
      const double apart = std::sqrt(tree_.box().distance2(at, node.center));
      const double ball = node.radius + tree_.rounding();
      if ((apart + ball) * detail::kInflate <= radius_) {
        is_covered_[static_cast<std::size_t>(k)] = true;
      } else if (apart <= (radius_ + ball) * detail::kInflate) {
        for (std::int32_t c = 0; c < node.children; ++c) covering_.push_back(node.first_child + c);
      }
    }
  }

  const PointTree& tree_;
  std::size_t most_;
  double radius_ = 0;
  std::vector<bool> is_covered_;  ///< by node, unless one above it is
  std::vector<Visit> path_;       ///< from the root to where the search for points that are not covered is
  std::vector<std::int32_t> covering_;
};

void check_k(std::int64_t k, const PointTree& tree) {
  if (k >= 1 && k <= static_cast<std::int64_t>(tree.size())) return;
  throw InvalidParameter(std::to_string(k) + " centers of " + std::to_string(tree.size()) +
                         " points were asked for; ask for 1 to the number of points");
}

/// Where points coincide, more centers may be asked for than there are places.
void add_others(const PointTree& tree, std::size_t most, std::vector<std::int32_t>& centers) {
  std::vector<std::int32_t> chosen = centers;
  std::sort(chosen.begin(), chosen.end());
  for (const std::int32_t id : tree.ids())
    if (centers.size() < most && !std::binary_search(chosen.begin(), chosen.end(), id)) centers.push_back(id);
}

}  // namespace

/// Take the first net with more than k centers, of radius R: they are more than R apart, and two of them have
/// the same one of any k centers, which is more than R / 2 from one of the two. The net before it, which is
/// among the first k, covers all points within 2 R: a net of radius 2 R, or, where radii are left out, one
/// that was measured to cover them within that. So the ratio is at most 4.
KCenters k_centers(const PointTree& tree, Span<const std::int64_t> k) {
  std::size_t most = 0;
  for (const std::int64_t one : k) {
    check_k(one, tree);
    most = std::max(most, static_cast<std::size_t>(one));
  }
  KCenters result;
  if (most == 0) return result;
  Nets nets(tree, most);
  nets.centers.push_back(tree.node(0).representative);
  while (nets.centers.size() < most) {
    const double covered2 = detail::covering_radius2(tree, nets.centers, nets.looked_at);
    if (covered2 == 0) break;
    nets.refine(detail::center_radius_below(std::sqrt(covered2), tree.base_radius()));
  }
  result.centers = nets.centers;
  add_others(tree, most, result.centers);
  for (const std::int64_t one : k) {
    const Span<const std::int32_t> first{result.centers.data(), static_cast<std::size_t>(one)};
    result.radius.push_back(std::sqrt(detail::covering_radius2(tree, first, nets.looked_at)));
  }
  result.looked_at = nets.looked_at;
  return result;
}

}  // namespace dch
