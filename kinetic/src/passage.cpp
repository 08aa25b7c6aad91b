// SPDX-License-Identifier: MIT
#include "passage.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/near_images.hpp"

namespace dch::kinetic {
namespace {

/// The motions of all images that are within a limit now.
std::vector<PairMotion> near_images(const Images& images, const FlightPlan& p, const FlightPlan& q,
                                    double distance, Vec3 apart, double limit) {
  std::vector<PairMotion> motions;
  detail::for_each_near_image(
      images.box(), images.box().nearest_image(apart), limit * kMargin, false,
      [&](Vec3 image) { motions.emplace_back(p, q, images.to_image(apart, image), distance); });
  return motions;
}

/// How long two points take at least to be a way farther apart, or nearer.
double time_for(double way, const FlightPlan& p, const FlightPlan& q, double now) {
  const double speed = std::sqrt(norm2(velocity_at(q, now) - velocity_at(p, now)));
  const double gain = std::sqrt(norm2(q.acceleration - p.acceleration));
  return 2 * way / (speed + std::sqrt(speed * speed + 2 * gain * way));
}

/// When the last of the images that are within has left, with none there to take over.
double when_none_is_within(const std::vector<PairMotion>& motions, double now, double horizon) {
  double time = now;
  for (bool goes_on = true; goes_on && time <= horizon;) {
    goes_on = false;
    for (const PairMotion& motion : motions) {
      if (!motion.is_within_after(time)) continue;
      const double leaves = motion.next_crossing(time, true);
      if (leaves <= time) continue;
      time = leaves;
      goes_on = true;
    }
  }
  return time;
}

}  // namespace

bool is_any_within(const Images& images, const FlightPlan& p, const FlightPlan& q, double distance,
                   double now) {
  const Vec3 apart = position_at(q, now) - position_at(p, now);
  const double nearest = std::sqrt(norm2(images.box().nearest_image(apart)));
  if (!images.box().any_periodic() || distance < images.box().max_cutoff())
    return PairMotion(p, q, images.to_nearest(apart), distance).is_within_after(now);
  if (nearest > distance * kMargin || nearest * kMargin < distance) return nearest < distance;
  const auto motions = near_images(images, p, q, distance, apart, distance);
  return std::any_of(motions.begin(), motions.end(),
                     [&](const PairMotion& motion) { return motion.is_within_after(now); });
}

Passage next_passage(const Images& images, const FlightPlan& p, const FlightPlan& q, double distance,
                     double now, bool is_within) {
  const Box& box = images.box();
  const Vec3 apart = position_at(q, now) - position_at(p, now);
  if (!box.any_periodic() || (is_within && distance < box.max_cutoff()))
    return {PairMotion(p, q, images.to_nearest(apart), distance).next_crossing(now, is_within), false};
  const double way = 0.5 * box.min_height(), nearest = std::sqrt(norm2(box.nearest_image(apart)));
  if (is_within && distance > box.max_distance()) return {};
  const double slack = std::abs(nearest - distance);
  if (slack > way) return {now + time_for(slack / kMargin, p, q, now), true};
  // What is nearest at some time before the horizon is at most twice the way farther than what is now. No
  // image comes within the distance that is not within it and the way.
  const double horizon = now + time_for(way, p, q, now);
  const auto motions =
      near_images(images, p, q, distance, apart, std::min(nearest + 2 * way, distance + way));
  double time = kNever;
  if (is_within) {
    time = when_none_is_within(motions, now, horizon);
  } else {
    for (const PairMotion& motion : motions) time = std::min(time, motion.next_crossing(now, false));
  }
  return time <= horizon ? Passage{time, false} : Passage{horizon, true};
}

}  // namespace dch::kinetic
