// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <dch/base/error.hpp>
#include <dch/proximity/well_separated_pairs.hpp>

#include "base/describe.hpp"
#include "dual_descent.hpp"
#include "gap_between.hpp"
#include "geometry/tolerance.hpp"

namespace dch {
namespace {

/// Whether a displacement stays the shortest of its images wherever its end is in a ball: the ball lies
/// inside the Voronoi cell of the lattice.
bool has_one_image(const Box& box, Vec3 displacement, double radius) {
  return std::all_of(box.relevant().begin(), box.relevant().end(), [&](Vec3 period) {
    const double length2 = norm2(period);
    return (std::abs(dot(displacement, period)) + radius * std::sqrt(length2)) * detail::kInflate <
           0.5 * length2;
  });
}

}  // namespace

WellSeparatedPairs well_separated_pairs(const PointTree& tree, double s) {
  if (!(std::isfinite(s) && s > 0))
    throw InvalidParameter("the separation s of well-separated pairs is " + detail::describe(s) +
                           "; it must be positive and finite, in radii of the larger ball");
  const Box& box = tree.box();
  WellSeparatedPairs result;
  const auto is_separated = [&](const PointTree::Node& a, const PointTree::Node& b) {
    const double larger = std::max(a.radius, b.radius);
    return detail::gap_between(tree, a, b) >= s * larger;  // of radius 0: always
  };
  result.looked_at = detail::for_each_separated_pair(tree, is_separated, [&](std::int32_t a, std::int32_t b) {
    const PointTree::Node &first = tree.node(a), &second = tree.node(b);
    const double radius = first.radius + second.radius + tree.rounding();
    result.pairs.push_back(
        {a, b, has_one_image(box, box.nearest_image(second.center - first.center), radius)});
  });
  return result;
}

}  // namespace dch
