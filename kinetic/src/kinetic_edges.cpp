// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <dch/base/error.hpp>
#include <dch/hierarchy/hierarchy_params.hpp>
#include <dch/kinetic/kinetic_edges.hpp>

#include "base/describe.hpp"
#include "geometry/position_check.hpp"

namespace dch::kinetic {
namespace {

using detail::describe;

bool is_in_range(double x) { return std::abs(x) <= kMaxMagnitude; }  // false for NaN
bool is_in_range(Vec3 v) { return is_in_range(v.x) && is_in_range(v.y) && is_in_range(v.z); }

void check(bool is_right, const std::string& what, const char* remedy) {
  if (is_right) return;
  throw InvalidParameter(what + " is not finite or beyond " + describe(kMaxMagnitude) + "; " + remedy);
}

void check_motion(std::size_t id, Vec3 velocity, Vec3 acceleration) {
  const std::string of = " of point " + std::to_string(id) + " = ";
  check(is_in_range(velocity), "velocity" + of + describe(velocity), "check what it was computed from");
  check(is_in_range(acceleration), "acceleration" + of + describe(acceleration),
        "check what it was computed from");
}

void check_length(double length, const std::string& what) {
  if (length >= kMinListRadius && length <= kMaxListRadius) return;
  throw InvalidParameter(what + " = " + describe(length) + " is not within " + describe(kMinListRadius) +
                         ".." + describe(kMaxListRadius) + "; use another unit of length");
}

/// Returns the largest distance of a pair.
double check_distances(const KineticParams& params, std::size_t points) {
  double largest = params.cutoff;
  if (params.radii.empty()) {
    check_length(params.cutoff, "cutoff");
  } else {
    if (params.radii.size() != points)
      throw InvalidParameter(std::to_string(params.radii.size()) + " radii for " + std::to_string(points) +
                             " points; give one for each, or none");
    for (std::size_t i = 0; i < points; ++i)
      check_length(params.radii[i], "radius of point " + std::to_string(i));
    largest = 2 * *std::max_element(params.radii.begin(), params.radii.end());
  }
  const double limit = kLargestShareOfBox * params.box.max_cutoff();
  if (largest > limit)
    throw CutoffTooLarge("the largest distance of a pair = " + describe(largest) + " exceeds " +
                         describe(limit) + ", " + describe(kLargestShareOfBox) +
                         " of half the smallest height of the periodic box, the rest being room for motion; "
                         "lower it or replicate the system");
  return largest;
}

void check_plans(Span<const FlightPlan> plans, double start, const Box& box) {
  check(is_in_range(start), "start = " + describe(start), "choose another origin of time");
  std::vector<Vec3> positions;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const std::string of = " of the plan of point " + std::to_string(i) + " = ";
    check(is_in_range(plans[i].time), "time" + of + describe(plans[i].time), "choose another origin of time");
    check(is_in_range(plans[i].position), "position" + of + describe(plans[i].position),
          "check the coordinates");
    check_motion(i, plans[i].velocity, plans[i].acceleration);
    if (plans[i].time > start)
      throw InvalidParameter("time" + of + describe(plans[i].time) + " is after the start, " +
                             describe(start) + "; give the plan that holds then");
    positions.push_back(position_at(plans[i], start));
  }
  detail::check_positions(positions, box);
}

}  // namespace

KineticEdges::KineticEdges(const KineticParams& params, Span<const FlightPlan> plans, double start)
    : params_(params), plans_(plans.begin(), plans.end()), now_(start) {
  check_distances(params, plans.size());
  check_plans(plans, start, params.box);
  for (FlightPlan& plan : plans_) plan.position = box().wrap(plan.position);
}

double KineticEdges::distance(Edge edge) const {
  return params_.radii.empty() ? params_.cutoff
                               : params_.radii[static_cast<std::size_t>(edge.a)] +
                                     params_.radii[static_cast<std::size_t>(edge.b)];
}

void KineticEdges::set_motion(std::int32_t id, Vec3 velocity, Vec3 acceleration) {
  if (id < 0 || static_cast<std::size_t>(id) >= size())
    throw InvalidParameter("point " + std::to_string(id) + " is not within 0.." +
                           std::to_string(static_cast<std::int64_t>(size()) - 1) +
                           "; ids are places in the "
                           "plans given at the start");
  check_motion(static_cast<std::size_t>(id), velocity, acceleration);
  plans_[static_cast<std::size_t>(id)] = {now_, box().wrap(position(id)), velocity, acceleration};
  follow(id);
}

std::optional<EdgeEvent> KineticEdges::step(double limit) {
  check(is_in_range(limit), "time = " + describe(limit), "step to a time that is");
  if (limit < now_)
    throw InvalidParameter("time = " + describe(limit) + " is before now, " + describe(now_) +
                           "; time does not run back: start anew from plans of then");
  return next_until(limit);
}

void KineticEdges::advance_to(double time, const EdgeCallback& callback) {
  while (const auto event = step(time))
    if (callback) callback(*event);
}

}  // namespace dch::kinetic
