// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/vec3.hpp>
#include <dch/kinetic/flight_plan.hpp>

#pragma GCC visibility push(default)
namespace dch::kinetic {

/// Two points under their flight plans, one image of each, and a distance d: when they come within it and
/// when they leave it. A certificate of thesis 5.5.1 holds until such a time.
///
/// f(t) = |q(t) - p(t)|^2 - d^2 is a polynomial of degree 2 for linear motion, of degree 4 otherwise. What
/// counts is where it changes its sign: a pair that only touches its distance has no crossing. The times of
/// all crossings depend on the two plans and the image alone, not on when they are asked for.
class PairMotion {
 public:
  /// @param shift added to the positions of `second` to get its image [length]
  /// @param distance d > 0 [length]
  PairMotion(const FlightPlan& first, const FlightPlan& second, Vec3 shift, double distance);

  /// Whether the pair is within the distance just after a time, which must be at or after the start of both
  /// plans. Where f is zero to within rounding its derivative decides, and then its second derivative: two
  /// spheres that touch and fly apart are not within their distance. A pair that stays at its distance is.
  bool is_within_after(double time) const;

  /// The first time at or after `after` at which the pair leaves the distance, if it is within now, or comes
  /// within it, if it is not; infinity if it never does.
  double next_crossing(double after, bool is_within) const;

 private:
  struct Extremes;
  Vec3 apart(double passed) const { return apart_ + passed * (velocity_ + (0.5 * passed) * acceleration_); }
  Vec3 rate(double passed) const { return velocity_ + passed * acceleration_; }
  double excess(double passed) const { return norm2(apart(passed)) - distance_ * distance_; }
  double next_linear(bool is_within) const;
  double next_quadratic(double after, bool is_within) const;
  Extremes extremes() const;

  double start_;       ///< from which on both plans hold [time]
  Vec3 apart_;         ///< from the first point to the image of the second, at the start [length]
  Vec3 velocity_;      ///< of the second relative to the first, at the start
  Vec3 acceleration_;  ///< of the second relative to the first
  double distance_;
  double magnitude_;  ///< of the coordinates that were subtracted: they are rounded to this share of it
  double speed_;      ///< of the velocities that were subtracted
};

}  // namespace dch::kinetic
#pragma GCC visibility pop
