// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include <dch/base/error.hpp>
#include <dch/hierarchy/hierarchy_params.hpp>
#include <dch/kinetic/kinetic_edges.hpp>

#include "argument_checks.hpp"
#include "base/describe.hpp"
#include "geometry/position_check.hpp"

namespace dch::kinetic {
namespace {

using detail::describe;

void check_motion(std::size_t id, Vec3 velocity, Vec3 acceleration) {
  const auto of_point = [&](const char* what) {
    return [what, id] { return what + std::string(" of point ") + std::to_string(id); };
  };
  check(velocity, of_point("velocity"), "check what it was computed from");
  check(acceleration, of_point("acceleration"), "check what it was computed from");
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
  const double limit = kMaxShareOfBox * params.box.max_cutoff();
  if (largest > limit)
    throw CutoffTooLarge("the largest distance of a pair = " + describe(largest) + " exceeds " +
                         describe(limit) + ", " + describe(kMaxShareOfBox) +
                         " of half the smallest height of the periodic box, the rest being room for motion; "
                         "lower it or replicate the system");
  return largest;
}

}  // namespace

void check_plans(Span<const FlightPlan> plans, double start, const Box& box) {
  check_time(start, "start");
  std::vector<Vec3> positions;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const auto of_plan = [&](const char* what) {
      return [what, i] { return what + std::string(" of the plan of point ") + std::to_string(i); };
    };
    check(plans[i].time, of_plan("time"), "choose another origin or unit of time");
    check(plans[i].position, of_plan("position"), "check the coordinates");
    check_motion(i, plans[i].velocity, plans[i].acceleration);
    if (plans[i].time > start)
      throw InvalidParameter(of_plan("time")() + " = " + describe(plans[i].time) + " is after the start, " +
                             describe(start) + "; give the plan that holds then");
    positions.push_back(position_at(plans[i], start));
  }
  detail::check_positions(positions, box);
}

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

/// What follows ends with is_whole_ = true, unless it throws.
void KineticEdges::begin_change() {
  if (!is_whole_)
    throw InvalidParameter("an earlier step or change of plan was broken off, at " + describe(now_) +
                           "; start anew from plans of then");
  is_whole_ = false;
}

void KineticEdges::set_motion(std::int32_t id, Vec3 velocity, Vec3 acceleration) {
  if (id < 0 || static_cast<std::size_t>(id) >= size())
    throw InvalidParameter("point " + std::to_string(id) + " is not within 0.." +
                           std::to_string(static_cast<std::int64_t>(size()) - 1) +
                           "; ids are places in the "
                           "plans given at the start");
  check_motion(static_cast<std::size_t>(id), velocity, acceleration);
  begin_change();
  plans_[static_cast<std::size_t>(id)] = {now_, box().wrap(position(id)), velocity, acceleration};
  follow(id);
  is_whole_ = true;
}

std::optional<EdgeEvent> KineticEdges::step(double limit) {
  check_time(limit, "time");
  if (limit < now_)
    throw InvalidParameter("time = " + describe(limit) + " is before now, " + describe(now_) +
                           "; time does not run back: start anew from plans of then");
  begin_change();
  const auto event = next_until(limit);
  is_whole_ = true;
  return event;
}

void KineticEdges::advance_to(double time, const EdgeCallback& callback) {
  while (const auto event = step(time))
    if (callback) callback(*event);
}

}  // namespace dch::kinetic
