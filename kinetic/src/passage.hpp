// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <dch/kinetic/flight_plan.hpp>
#include <dch/kinetic/pair_motion.hpp>

#include "images.hpp"

namespace dch::kinetic {

/// When two points, by their nearest images, come within a distance or leave it: the distance may be larger
/// than the box, with many images of a point within it.
struct Passage {
  double time = kNever;
  bool is_renewal = false;  ///< nothing is known beyond that time, since farther images may come in
};

/// Whether some image is within the distance just after `now`.
bool is_any_within(const Images& images, const FlightPlan& p, const FlightPlan& q, double distance,
                   double now);

/// The first time from `now` on at which that changes.
Passage next_passage(const Images& images, const FlightPlan& p, const FlightPlan& q, double distance,
                     double now, bool is_within);

}  // namespace dch::kinetic
