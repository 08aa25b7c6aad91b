// SPDX-License-Identifier: MIT
#include "covering_radius.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

class CoveringRadius {
 public:
  explicit CoveringRadius(const PointTree& tree) : tree_(tree) {}

  /// Takes the points below a node into account.
  /// @param centers among them the nearest of each of these points
  void look_at(const PointTree::Node& node, Span<const std::int32_t> centers) {
    looked_at += static_cast<std::int64_t>(centers.size());
    if (node.points == 1) {
      double least2 = std::numeric_limits<double>::infinity();
      for (const std::int32_t center : centers)
        least2 = std::min(least2, tree_.distance2(center, node.representative));
      radius2 = std::max(radius2, least2);
      return;
    }
    // Of a point below the node: from some center surely no farther than this, from the center itself surely
    // no nearer than its distance from the ball.
    std::vector<double> from_middle;
    for (const std::int32_t center : centers)
      from_middle.push_back(std::sqrt(tree_.box().distance2(tree_.position(center), node.center)));
    const double nearest = *std::min_element(from_middle.begin(), from_middle.end());
    const double farther = (nearest + node.radius + tree_.rounding()) * kInflate;
    if (farther * farther * kInflate <= radius2) return;
    const double most = (nearest + 2 * (node.radius + tree_.rounding())) * kInflate;
    std::vector<std::int32_t> left;
    for (std::size_t c = 0; c < centers.size(); ++c)
      if (from_middle[c] <= most) left.push_back(centers[c]);
    for (std::int32_t k = 0; k < node.children; ++k) look_at(tree_.node(node.first_child + k), left);
  }

  double radius2 = 0;  ///< of the points that were looked at
  std::int64_t looked_at = 0;

 private:
  const PointTree& tree_;
};

}  // namespace

double covering_radius2(const PointTree& tree, Span<const std::int32_t> centers, std::int64_t& looked_at) {
  CoveringRadius search(tree);
  search.look_at(tree.node(0), centers);
  looked_at += search.looked_at;
  return search.radius2;
}

}  // namespace dch::detail
