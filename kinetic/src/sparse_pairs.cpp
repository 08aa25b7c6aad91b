// SPDX-License-Identifier: MIT
#include "sparse_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace dch::kinetic {
namespace {

/// How long a point is within a way of where it is.
double time_for(double way, const FlightPlan& plan, double now) {
  const double speed = std::sqrt(norm2(velocity_at(plan, now))), gain = std::sqrt(norm2(plan.acceleration));
  const double sum = speed + std::sqrt(speed * speed + 2 * gain * way);
  return sum > 0 ? 2 * way / sum : kNever;
}

}  // namespace

/// An image is the nearest one where its displacement is in the Voronoi cell of the lattice. On the straight
/// way to there the nearest image changes across facets of cells, by relevant vectors, and is one of those
/// looked for each time: so they are found from neighbor to neighbor.
void for_each_image_near(const Box& box, Vec3 displacement, double way, const std::function<void(Vec3)>& f) {
  const Vec3 nearest = box.nearest_image(displacement);
  std::vector<Vec3> found{nearest};
  const auto is_candidate = [&](Vec3 image) {
    return std::all_of(box.relevant().begin(), box.relevant().end(), [&](Vec3 v) {
      return std::abs(dot(image, v)) <= (0.5 * norm2(v) + way * std::sqrt(norm2(v))) * kMargin;
    });
  };
  const double same2 = 0.01 * box.shortest_period() * box.shortest_period();
  const auto is_new = [&](Vec3 image) {
    return std::none_of(found.begin(), found.end(), [&](Vec3 known) { return norm2(image - known) < same2; });
  };
  for (std::size_t k = 0; k < found.size(); ++k) {
    f(found[k] - displacement);
    for (const Vec3 v : box.relevant())
      for (const Vec3 image : {found[k] + v, found[k] - v})
        if (is_candidate(image) && is_new(image)) found.push_back(image);
  }
}

/// With each point within half a way of where it is, distances change by the way at most: the closest pair
/// has a distance of at most the smallest one now and the way then, and now of at most the way more.
SparsePairs find_sparse_pairs(const Images& images, Span<const FlightPlan> plans, double now) {
  const Box& box = images.box();
  std::vector<Vec3> at;
  for (const FlightPlan& plan : plans) at.push_back(position_at(plan, now));
  double closest2 = kNever;
  for (std::size_t a = 0; a < at.size(); ++a)
    for (std::size_t b = a + 1; b < at.size(); ++b)
      closest2 = std::min(closest2, box.distance2(at[a], at[b]));
  SparsePairs found;
  if (at.size() < 2) return found;
  const double closest = std::sqrt(closest2), way = 0.25 * std::min(closest, box.max_cutoff());
  const double reach = (closest + 2 * way) * kMargin;
  for (std::size_t a = 0; a < at.size(); ++a) {
    found.horizon = std::min(found.horizon, now + time_for(0.5 * way, plans[a], now));
    for (std::size_t b = a + 1; b < at.size(); ++b) {
      if (box.distance2(at[a], at[b]) > reach * reach) continue;
      const Edge edge{static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)};
      const Vec3 apart = at[b] - at[a];
      for_each_image_near(box, apart, way, [&](Vec3 shift) {
        found.contenders.push_back(
            {edge, PairPath(plans[a], plans[b], images.to_image(apart, apart + shift))});
      });
    }
  }
  return found;
}

}  // namespace dch::kinetic
