// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/zonotope/membership.hpp>
#include <dch/zonotope/space_time.hpp>
#include <dch/zonotope/zonogon.hpp>

#include "base/describe.hpp"
#include "vectors.hpp"

namespace dch::zonotope {
namespace {

using detail::describe;

constexpr double kPi = 3.14159265358979323846;
constexpr double kRoundUp = 1e-14;

Vec3 unit(Vec3 v) {
  const Vec3 m = magnitudes(v);
  const Vec3 scaled = 1 / std::max({m.x, m.y, m.z}) * v;
  return 1 / std::sqrt(norm2(scaled)) * scaled;
}

bool has_turn(const RigidMotion& motion) { return motion.angle != 0; }

void check_motion(const RigidMotion& motion) {
  check({motion.axis_point, {motion.translation, motion.axis}});
  if (!std::isfinite(motion.angle))
    throw InvalidParameter("the angle of a motion is " + describe(motion.angle) + "; it has to be finite");
  if (has_turn(motion) && motion.axis == Vec3{})
    throw InvalidParameter("the axis of a motion is 0, but it turns by " + describe(motion.angle) +
                           "; give a direction, or no angle");
}

void check_time(double s) {
  if (s >= 0 && s <= 1) return;
  throw InvalidParameter("a time of " + describe(s) + " is outside of the step, 0..1");
}

/// Rodrigues' formula.
Vec3 turned(Vec3 v, Vec3 axis, double angle) {
  const double half = std::sin(0.5 * angle);
  return v + std::sin(angle) * dch::cross(axis, v) + 2 * half * half * dch::cross(axis, dch::cross(axis, v));
}

Zonotope place(const Zonotope& body, const RigidMotion& motion, double s) {
  Zonotope result = body;
  if (has_turn(motion)) {
    const Vec3 axis = unit(motion.axis);
    for (Vec3& v : result.generators) v = turned(v, axis, s * motion.angle);
    result.center = motion.axis_point + turned(body.center - motion.axis_point, axis, s * motion.angle);
  }
  result.center = result.center + s * motion.translation;
  return result;
}

/// Two unit vectors across a unit vector.
void across(Vec3 axis, Vec3& first, Vec3& second) {
  const Vec3 m = magnitudes(axis);
  const Vec3 other = m.x <= m.y && m.x <= m.z ? Vec3{1, 0, 0} : m.y <= m.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  first = unit(dch::cross(axis, other));
  second = unit(dch::cross(axis, first));
}

/// The distance of the farthest vertex from the axis: of the zonogon that the body projects to.
double farthest(const Zonotope& body, Vec3 axis_point, Vec3 first, Vec3 second) {
  const auto projected = [&](Vec3 v) { return Vec2{dch::dot(v, first), dch::dot(v, second)}; };
  Zonogon shadow{projected(body.center - axis_point), {}};
  for (const Vec3& v : body.generators) shadow.generators.push_back(projected(v));
  double square = dot(shadow.center, shadow.center);
  for (const Vec2& vertex : vertices(shadow)) square = std::max(square, dot(vertex, vertex));
  return std::sqrt(square);
}

Zonotope sweep(const Zonotope& body, const RigidMotion& motion, double from, double to) {
  Zonotope result = place(body, motion, from);
  const Vec3 half = 0.5 * (to - from) * motion.translation;
  const Vec3 sizes = magnitudes(result.center);
  const double reach = std::max({sizes.x, sizes.y, sizes.z});
  if (has_turn(motion)) {
    const double angle = std::abs((to - from) * motion.angle);
    Vec3 first, second;
    across(unit(motion.axis), first, second);
    const double rho = farthest(result, motion.axis_point + from * motion.translation, first, second);
    const double width = 2 * rho * std::sin(0.5 * angle) + kRoundUp * (rho + reach);
    result.generators.push_back(width * first);
    result.generators.push_back(width * second);
  }
  result.center = result.center + half;
  if (half != Vec3{}) result.generators.push_back((1 + kRoundUp) * half);
  return result;
}

void check_bodies(const Zonotope& a, const RigidMotion& motion_a, const Zonotope& b,
                  const RigidMotion& motion_b) {
  check(a);
  check(b);
  check_motion(motion_a);
  check_motion(motion_b);
}

}  // namespace

Zonotope placed(const Zonotope& body, const RigidMotion& motion, double s) {
  check(body);
  check_motion(motion);
  check_time(s);
  return place(body, motion, s);
}

Zonotope swept_volume(const Zonotope& body, const RigidMotion& motion, double from, double to) {
  check(body);
  check_motion(motion);
  check_time(from);
  check_time(to);
  if (from > to)
    throw InvalidParameter("the times from " + describe(from) + " to " + describe(to) +
                           " run backward; exchange them");
  if (!(std::abs((to - from) * motion.angle) < kPi))
    throw InvalidParameter("a turn by " + describe((to - from) * motion.angle) +
                           " is not below 180 degrees; split the step");
  return sweep(body, motion, from, to);
}

FirstMeeting first_meeting(const Zonotope& a, const RigidMotion& motion_a, const Zonotope& b,
                           const RigidMotion& motion_b, double tolerance) {
  check_bodies(a, motion_a, b, motion_b);
  if (!(tolerance >= 1e-12 && tolerance <= 1))
    throw InvalidParameter("a tolerance of " + describe(tolerance) + " of the time is not within 1e-12..1");
  struct Interval {
    double from, to;
  };
  FirstMeeting result;
  std::vector<Interval> open{{0, 1}};
  while (!open.empty()) {
    const Interval now = open.back();
    open.pop_back();
    const double middle = 0.5 * (now.from + now.to), length = now.to - now.from;
    const bool is_wide = !(length * std::max(std::abs(motion_a.angle), std::abs(motion_b.angle)) < kPi);
    if (!is_wide) {
      ++result.intervals;
      if (!intersect(sweep(a, motion_a, now.from, now.to), sweep(b, motion_b, now.from, now.to))) continue;
      for (const double s : {now.from, middle, now.to}) {
        if (length > tolerance) break;
        if (!intersect(place(a, motion_a, s), place(b, motion_b, s))) continue;
        result.outcome = Meeting::contact;
        result.from = now.from;
        result.to = s;
        return result;
      }
    }
    if (length <= tolerance && !is_wide) {
      result.outcome = Meeting::undecided;
      result.from = now.from;
      result.to = now.to;
      return result;
    }
    open.push_back({middle, now.to});
    open.push_back({now.from, middle});
  }
  return result;
}

}  // namespace dch::zonotope
