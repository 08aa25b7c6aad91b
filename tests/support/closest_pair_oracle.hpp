// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/kinetic/kinetic_closest_pair.hpp>

namespace dch::kinetic {

/// All flight plans that points have had, and from them by all pairs in long double whether the pair that was
/// said to be the closest one was so at every time. It knows no polynomials: distances change no faster than
/// the points move.
class ClosestPairOracle {
 public:
  explicit ClosestPairOracle(const KineticClosestPair& engine)
      : engine_(engine), since_(engine.now()), claimed_(engine.pair()) {
    for (std::int32_t id = 0; id < static_cast<std::int32_t>(engine.size()); ++id)
      plans_.push_back(engine.plan(id));
  }

  /// To be called after set_motion().
  void note(std::int32_t id) {
    catch_up(engine_.now());
    plans_[static_cast<std::size_t>(id)] = engine_.plan(id);
  }

  /// To be called with each change, before plans are changed.
  void note(const ClosestChange& change) {
    ASSERT_EQ(change.time, engine_.now());
    ASSERT_EQ(change.before, claimed_);
    ASSERT_FALSE(change.after == claimed_) << "no change at " << change.time;
    ASSERT_EQ(change.after, engine_.pair());
    catch_up(change.time);
    ASSERT_NEAR(static_cast<double>(distance(change.before, change.time)),
                static_cast<double>(distance(change.after, change.time)), kSame * scale(change.time))
        << "at " << change.time;
    claimed_ = change.after;
  }

  /// No pair is closer than the one that is claimed, by more than rounding now, and by more than kNear at any
  /// time since the call before.
  void check() {
    catch_up(engine_.now());
    ASSERT_EQ(claimed_, engine_.pair());
    ASSERT_EQ(claimed_.a < 0, plans_.size() < 2);
    if (claimed_.a < 0) return;
    const double now = engine_.now();
    const long double claimed = distance(claimed_, now);
    EXPECT_NEAR(static_cast<double>(claimed), engine_.distance(), kSame * scale(now));
    for_each_pair([&](Edge edge) {
      EXPECT_LE(static_cast<double>(claimed - distance(edge, now)), kSame * scale(now))
          << edge.a << ", " << edge.b << " is closer than " << claimed_.a << ", " << claimed_.b << " at "
          << now;
    });
  }

 private:
  static constexpr double kSame = 1e-9, kNear = 1e-3;

  template <class F>
  void for_each_pair(const F& f) const {
    for (std::int32_t a = 0; a < static_cast<std::int32_t>(plans_.size()); ++a)
      for (std::int32_t b = a + 1; b < static_cast<std::int32_t>(plans_.size()); ++b) f(Edge{a, b});
  }
  /// Points that are accelerated go far.
  double scale(double time) const {
    double most = 1;
    for (const FlightPlan& plan : plans_) most = std::max(most, std::sqrt(norm2(position_at(plan, time))));
    return most;
  }
  static long double along(const FlightPlan& plan, int axis, long double time) {
    const long double t = time - plan.time;
    return plan.position[axis] + t * (plan.velocity[axis] + t * plan.acceleration[axis] / 2);
  }
  long double distance(Edge edge, long double time) const {
    const FlightPlan &p = plans_[static_cast<std::size_t>(edge.a)],
                     &q = plans_[static_cast<std::size_t>(edge.b)];
    long double d[3];
    Vec3 rounded;
    for (int axis = 0; axis < 3; ++axis) {
      d[axis] = along(q, axis, time) - along(p, axis, time);
      rounded[axis] = static_cast<double>(d[axis]);
    }
    const Vec3 shift = engine_.box().nearest_image(rounded) - rounded;
    long double sum = 0;
    for (int axis = 0; axis < 3; ++axis) sum += (d[axis] + shift[axis]) * (d[axis] + shift[axis]);
    return std::sqrt(sum);
  }
  /// Of two points, between two times.
  double fastest(Edge edge, double from, double to) const {
    const FlightPlan &p = plans_[static_cast<std::size_t>(edge.a)],
                     &q = plans_[static_cast<std::size_t>(edge.b)];
    return std::sqrt(std::max(norm2(velocity_at(q, from) - velocity_at(p, from)),
                              norm2(velocity_at(q, to) - velocity_at(p, to))));
  }

  void catch_up(double time) {
    if (claimed_.a >= 0 && time > since_)
      for_each_pair([&](Edge edge) {
        if (!(edge == claimed_)) halve(edge, since_, time, lead(edge, since_), lead(edge, time));
      });
    since_ = time;
  }
  /// How much closer the claimed pair is.
  long double lead(Edge edge, double time) const { return distance(edge, time) - distance(claimed_, time); }
  void halve(Edge edge, double from, double to, long double lead_from, long double lead_to) {
    const double most = fastest(edge, from, to) + fastest(claimed_, from, to);
    if (lead_from + lead_to > most * (to - from) - 2 * kNear) return;
    if (lead_from < -kNear || lead_to < -kNear || to - from < 1e-9) {
      ADD_FAILURE() << edge.a << ", " << edge.b << " is closer than " << claimed_.a << ", " << claimed_.b
                    << " between " << from << " and " << to;
      return;
    }
    const double middle = 0.5 * (from + to);
    const long double lead_middle = lead(edge, middle);
    halve(edge, from, middle, lead_from, lead_middle);
    halve(edge, middle, to, lead_middle, lead_to);
  }

  const KineticClosestPair& engine_;
  double since_;
  Edge claimed_;
  std::vector<FlightPlan> plans_;  ///< by point, those since then
};

}  // namespace dch::kinetic
