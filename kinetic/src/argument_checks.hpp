// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>

#include <dch/base/error.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/hierarchy/hierarchy_params.hpp>
#include <dch/kinetic/flight_plan.hpp>

#include "base/describe.hpp"

namespace dch::kinetic {

inline bool is_in_range(double x) { return std::abs(x) <= kMaxMagnitude; }  // false for NaN
inline bool is_in_range(Vec3 v) { return is_in_range(v.x) && is_in_range(v.y) && is_in_range(v.z); }

/// @param what names the value, whose text is made for an error alone: the check is made at every event
template <class Value, class What>
void check(const Value& value, const What& what, const char* remedy) {
  if (is_in_range(value)) return;
  throw InvalidParameter(what() + " = " + detail::describe(value) + " is not finite or beyond " +
                         detail::describe(kMaxMagnitude) + "; " + remedy);
}

inline void check_time(double time, const char* name) {
  check(
      time, [&] { return std::string(name); }, "choose another origin or unit of time");
}

inline void check_length(double length, const std::string& what) {
  if (length >= kMinListRadius && length <= kMaxListRadius) return;
  throw InvalidParameter(what + " = " + detail::describe(length) + " is not within " +
                         detail::describe(kMinListRadius) + ".." + detail::describe(kMaxListRadius) +
                         "; use another unit of length");
}

/// @throws InvalidParameter, InvalidPosition for plans that make_kinetic_edges() does not take.
void check_plans(Span<const FlightPlan> plans, double start, const Box& box);

}  // namespace dch::kinetic
