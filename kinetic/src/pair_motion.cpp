// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <dch/kinetic/pair_motion.hpp>

#include "bracketed_root.hpp"

namespace dch::kinetic {
namespace {

/// A bound on the roundings of each of the quantities below, in units of what is rounded.
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

/// At least the length of a vector.
double sum(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// Polynomial of degree 3, lowest coefficient first.
struct Cubic {
  std::array<double, 4> c;
  double operator()(double x) const { return c[0] + x * (c[1] + x * (c[2] + x * c[3])); }
  double slope(double x) const { return c[1] + x * (2 * c[2] + x * 3 * c[3]); }
};

/// Where the slope of a cubic with c[3] > 0 is zero, ascending; none where it only rises.
int turning_points(const Cubic& f, std::array<double, 2>& at) {
  const double half = f.c[2], discriminant = f.c[2] * f.c[2] - 3 * f.c[3] * f.c[1];
  if (!(discriminant > 0)) return 0;
  const double q = -(half + std::copysign(std::sqrt(discriminant), half));
  at = {q / (3 * f.c[3]), f.c[1] / q};
  if (at[0] > at[1]) std::swap(at[0], at[1]);
  return 2;
}

/// From `low` on by doubling to where a function that grows without bound from there on is positive.
template <class Value>
double bound_above(const Value& value, double low) {
  double high = low > 0 ? 2 * low : 1;
  while (!(value(high) > 0)) high *= 2;
  return high;
}

}  // namespace

/// Where f of quadratic motion turns after the start, ascending.
struct PairMotion::Extremes {
  int count = 0;
  std::array<double, 3> at{};
};

PairMotion::PairMotion(const FlightPlan& first, const FlightPlan& second, Vec3 shift, double distance)
    : start_(std::max(first.time, second.time)), distance_(distance) {
  const Vec3 p = position_at(first, start_), q = position_at(second, start_);
  const Vec3 u = velocity_at(first, start_), v = velocity_at(second, start_);
  apart_ = (q - p) + shift;
  velocity_ = v - u;
  acceleration_ = second.acceleration - first.acceleration;
  magnitude_ = sum(p) + sum(q) + sum(shift);
  speed_ = sum(u) + sum(v);
}

bool PairMotion::is_within_after(double time) const {
  const double passed = time - start_;
  const Vec3 d = apart(passed), v = rate(passed);
  const double f = norm2(d) - distance_ * distance_;
  // Positions are off by the rounding of coordinates, and of the time that they are taken at.
  const double far = sum(d) + distance_, fast = sum(v) + speed_;
  const double off = kRounding * (magnitude_ + far + fast * (std::abs(time) + passed));
  if (std::abs(f) > off * far) return f < 0;
  const double slope = dot(d, v);
  if (std::abs(slope) > off * fast + kRounding * speed_ * far) return slope < 0;
  const double curvature = norm2(v) + dot(d, acceleration_);
  return curvature == 0 ? f <= 0 : curvature < 0;
}

double PairMotion::next_crossing(double after, bool is_within) const {
  if (acceleration_ != Vec3{}) return next_quadratic(after, is_within);
  const double time = next_linear(is_within);
  if (time < after) return kNever;
  return time;
}

/// |d + v t|^2 = D^2 has the discriminant v^2 D^2 - |d x v|^2, which cancels nothing far away.
double PairMotion::next_linear(bool is_within) const {
  const double b = dot(apart_, velocity_);
  if (!is_within && b >= 0) return kNever;
  const double a = norm2(velocity_), c = excess(0);
  const double discriminant = a * distance_ * distance_ - norm2(cross(apart_, velocity_));
  if (!(discriminant > 0) || a == 0) return kNever;
  const double root = std::sqrt(discriminant);
  // Of -b + root and -b - root the one that adds; the other root is c over it.
  const double q = b < 0 ? root - b : -(b + root);
  const double enters = b < 0 ? c / q : q / a, leaves = b < 0 ? q / a : c / q;
  return start_ + (is_within ? leaves : enters);
}

/// Half the slope of f, d . v, is a cubic; between its roots f is monotone.
PairMotion::Extremes PairMotion::extremes() const {
  const Cubic slope{{dot(apart_, velocity_), norm2(velocity_) + dot(apart_, acceleration_),
                     1.5 * dot(velocity_, acceleration_), 0.5 * norm2(acceleration_)}};
  const auto rate_of = [&](double x) { return slope.slope(x); };
  std::array<double, 2> turns{};
  const int count = turning_points(slope, turns);
  std::array<double, 4> cuts{0};
  int last = 0;
  for (int k = 0; k < count; ++k)
    if (turns[k] > 0) cuts[++last] = turns[k];
  cuts[last + 1] = bound_above(slope, cuts[last]);
  Extremes found;
  for (int k = 0; k <= last; ++k)
    if ((slope(cuts[k]) <= 0) != (slope(cuts[k + 1]) <= 0))
      found.at[found.count++] = bracketed_root(slope, rate_of, cuts[k], cuts[k + 1]);
  return found;
}

double PairMotion::next_quadratic(double after, bool is_within) const {
  const auto value = [&](double x) { return excess(x); };
  const auto rate_of = [&](double x) { return 2 * dot(apart(x), rate(x)); };
  const Extremes turns = extremes();
  double low = 0;
  bool was_within = value(low) <= 0;
  for (int k = 0; k <= turns.count; ++k) {
    const double high = k < turns.count ? turns.at[k] : bound_above(value, low), there = value(high);
    const bool stays = there == 0 || was_within == (there < 0);  // zero: it touches, and turns
    if (!stays && was_within == is_within) {
      const double time = start_ + bracketed_root(value, rate_of, low, high);
      if (time >= after) return time;
    }
    was_within = was_within == stays;
    low = high;
  }
  return kNever;
}

}  // namespace dch::kinetic
