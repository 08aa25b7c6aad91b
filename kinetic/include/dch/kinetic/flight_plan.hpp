// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch::kinetic {

/// How a point moves from a time on, until it is given another plan: linear motion, or quadratic motion where
/// there is an acceleration. Times and lengths are in the caller's units.
struct FlightPlan {
  double time = 0;      ///< from which on the plan holds [time]
  Vec3 position{};      ///< then; in a periodic box any image of it [length]
  Vec3 velocity{};      ///< then [length/time]
  Vec3 acceleration{};  ///< [length/time^2]

  bool is_linear() const { return acceleration == Vec3{}; }
};

inline Vec3 position_at(const FlightPlan& plan, double time) {
  const double passed = time - plan.time;
  return plan.position + passed * (plan.velocity + (0.5 * passed) * plan.acceleration);
}
inline Vec3 velocity_at(const FlightPlan& plan, double time) {
  return plan.velocity + (time - plan.time) * plan.acceleration;
}

/// Largest magnitude of a time, a coordinate, or a component of a velocity or an acceleration that is taken:
/// fourth powers of it, which discriminants hold, stay far from overflow.
inline constexpr double kMaxMagnitude = 1e50;

/// The time of what does not happen.
inline constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace dch::kinetic
#pragma GCC visibility pop
