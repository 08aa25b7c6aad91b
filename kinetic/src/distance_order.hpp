// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include <dch/base/vec3.hpp>
#include <dch/kinetic/flight_plan.hpp>

namespace dch::kinetic {

/// Where one image of a point is from another point, under the flight plans of both.
struct PairPath {
  PairPath() = default;
  /// @param shift added to the positions of `second` to get its image [length]
  PairPath(const FlightPlan& first, const FlightPlan& second, Vec3 shift);

  double start = 0;  ///< from which on both plans hold [time]
  Vec3 apart;        ///< then [length]
  Vec3 velocity;     ///< then
  Vec3 acceleration;
};

/// Which of two pairs is the closer one, at every time: a certificate of a kinetic tournament.
///
/// The difference of the squared distances is a polynomial of degree 2 for linear motion, of degree 4
/// otherwise. What counts is where it changes its sign, found once, from the start of all plans on: pairs
/// that are equally close for a moment have no event, and the winner after a time and the time at which it
/// loses never contradict each other, however roots are rounded.
class DistanceOrder {
 public:
  DistanceOrder(const PairPath& first, const PairPath& second);

  /// Just after a time: negative if the first pair is the closer one, positive if the second one is, 0 if
  /// they are equally close for good.
  int sign_after(double time) const;
  /// The first time after `time` at which that changes; infinity if it never does.
  double next_change(double time) const;

 private:
  int first_sign_ = 0;
  int count_ = 0;
  std::array<double, 4> changes_{};  ///< ascending [time]
};

}  // namespace dch::kinetic
