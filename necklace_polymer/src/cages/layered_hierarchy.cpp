// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include <dch/necklace/layered_hierarchy.hpp>

#include "balls/ball_basis.hpp"

namespace dch::necklace {

namespace {

Ball around_both(const Ball& a, const Ball& b) {
  const Vec3 d = b.center - a.center;
  const double distance = std::sqrt(norm2(d));
  if (distance + b.radius <= a.radius) return a;
  if (distance + a.radius <= b.radius) return b;
  Ball ball;
  ball.center = a.center + (0.5 * (1 + (b.radius - a.radius) / distance)) * d;
  ball.radius = std::max(detail::far_side(ball.center, a), detail::far_side(ball.center, b));
  return ball;
}

}  // namespace

LayeredHierarchy::LayeredHierarchy(Necklace necklace, const LayeredParams& params)
    : CageHierarchy(std::move(necklace), params.leaf_beads) {}

void LayeredHierarchy::update(Span<const Vec3> positions, const Box& box) {
  take(positions, box);
  std::vector<Ball>& cages = mutable_cages();
  for (std::size_t k = cages.size(); k-- > 0;) {
    const ChainTrees::Node& node = trees().nodes()[k];
    cages[k] = node.is_leaf()
                   ? enclosing_ball({beads().data() + node.first, static_cast<std::size_t>(node.count)}).ball
                   : around_both(cages[k + 1], cages[static_cast<std::size_t>(node.right)]);
  }
}

}  // namespace dch::necklace
