// SPDX-License-Identifier: MIT
#include "measured_ball.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

double farthest2(const Box& box, Span<const Vec3> at, Vec3 from) {
  double most = 0;
  for (const Vec3 p : at) most = std::max(most, box.distance2(from, p));
  return most;
}

/// Center of the box around the points, as seen from the first of them. In a periodic box as small as the
/// node that may be a poor center, but the radius is measured from it all the same.
Vec3 middle(const Box& box, Span<const Vec3> at) {
  Vec3 low, high;
  for (std::size_t p = 1; p < at.size(); ++p) {
    const Vec3 d = box.nearest_image(at[p] - at[0]);
    low = {std::min(low.x, d.x), std::min(low.y, d.y), std::min(low.z, d.z)};
    high = {std::max(high.x, d.x), std::max(high.y, d.y), std::max(high.z, d.z)};
  }
  return box.wrap(at[0] + 0.5 * (low + high));
}

/// The place of the point nearest to another, the first of several.
std::size_t nearest(const Box& box, Span<const Vec3> at, Vec3 to) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t place = 0; place < at.size(); ++place) {
    const double d2 = box.distance2(to, at[place]);
    if (d2 >= least) continue;
    best = place;
    least = d2;
  }
  return best;
}

/// @param radius of the ball around the node's center
void take_representative(const Box& box, PointsOfNode points, double radius, PointTree::Node& node) {
  const std::size_t place = nearest(box, points.at, node.center);
  node.representative = points.ids[place];
  node.radius = radius * kInflate;
  node.reach = std::sqrt(farthest2(box, points.at, points.at[place])) * kInflate;
  // Points that coincide have no radius, though rounding may put their middle beside them.
  if (node.radius > 0 && node.radius < node.reach) return;
  node.center = points.at[place];
  node.radius = node.reach;
}

}  // namespace

void measure_ball(const Box& box, PointsOfNode points, PointTree::Node& node) {
  node.center = middle(box, points.at);
  take_representative(box, points, std::sqrt(farthest2(box, points.at, node.center)), node);
}

void measure_ball_again(const Box& box, PointsOfNode points, PointTree::Node& node) {
  const Vec3 in_the_middle = middle(box, points.at);
  const double before2 = farthest2(box, points.at, node.center);
  const double now2 = farthest2(box, points.at, in_the_middle);
  if (now2 <= before2) node.center = in_the_middle;
  take_representative(box, points, std::sqrt(std::min(now2, before2)), node);
}

}  // namespace dch::detail
