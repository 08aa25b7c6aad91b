// SPDX-License-Identifier: MIT
//
// When two points come within a distance and when they leave it, against dense sampling in long double; and
// what is decided where they only touch it.
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/kinetic/pair_motion.hpp>

#include "effort.hpp"
#include "random.hpp"

namespace dch::kinetic {
namespace {

/// |q - p| - d in long double.
class LongDoublePair {
 public:
  LongDoublePair(const FlightPlan& p, const FlightPlan& q, double distance)
      : p_(p), q_(q), distance_(distance) {}
  long double gap(long double time) const {
    long double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const long double d = along(q_, axis, time) - along(p_, axis, time);
      sum += d * d;
    }
    return std::sqrt(sum) - distance_;
  }
  /// Where the gap changes its sign in [from, to], on a grid, halved to the last digit.
  std::vector<long double> crossings(long double from, long double to, int samples) const {
    std::vector<long double> found;
    long double low = from;
    for (int k = 1; k <= samples; ++k) {
      const long double high = from + (to - from) * k / samples;
      if ((gap(low) <= 0) != (gap(high) <= 0)) found.push_back(halved(low, high));
      low = high;
    }
    return found;
  }

 private:
  static long double along(const FlightPlan& plan, int axis, long double time) {
    const long double t = time - plan.time;
    return plan.position[axis] + t * (plan.velocity[axis] + t * plan.acceleration[axis] / 2);
  }
  long double halved(long double low, long double high) const {
    const bool was_within = gap(low) <= 0;
    for (int k = 0; k < 80; ++k) {
      const long double middle = (low + high) / 2;
      ((gap(middle) <= 0) == was_within ? low : high) = middle;
    }
    return low;
  }
  FlightPlan p_, q_;
  long double distance_;
};

/// Expects the crossings to be those of long double, each the other way round than the one before.
void expect_crossings(const FlightPlan& p, const FlightPlan& q, double distance, double end,
                      const std::string& what) {
  const double start = std::max(p.time, q.time);
  const LongDoublePair exact(p, q, distance);
  const PairMotion motion(p, q, {}, distance);
  bool is_within = motion.is_within_after(start);
  ASSERT_EQ(is_within, exact.gap(start) <= 0) << what;
  double now = start;
  for (const long double crossing : exact.crossings(start, end, 4000)) {
    now = motion.next_crossing(now, is_within);
    const double slope =
        static_cast<double>(std::abs(exact.gap(crossing + 1e-6L) - exact.gap(crossing - 1e-6L)) / 2e-6L);
    ASSERT_NEAR(now, static_cast<double>(crossing), 1e-12 * (1 + end) * (1 + 1 / slope)) << what;
    is_within = !is_within;
  }
  ASSERT_GT(motion.next_crossing(now, is_within), end * (1 - 1e-9)) << what;
}

FlightPlan random_plan(scenes::Random& random, double time, double curved) {
  return {time, random.in_cube(2), random.in_cube(1), curved * random.in_cube(0.3)};
}

TEST(PairMotion, LinearCrossingsAreThoseOfLongDouble) {
  scenes::Random random(31);
  for (int k = 0; k < effort(400); ++k)
    ASSERT_NO_FATAL_FAILURE(expect_crossings(random_plan(random, 0, 0), random_plan(random, 0.5, 0),
                                             random.uniform(0.2, 2), 12, "pair " + std::to_string(k)));
}

TEST(PairMotion, QuadraticCrossingsAreThoseOfLongDouble) {
  scenes::Random random(32);
  int most = 0;
  for (int k = 0; k < effort(400); ++k) {
    FlightPlan p = random_plan(random, 0, 1), q = random_plan(random, 0.5, random.below(2) == 0 ? 0 : 1);
    if (random.below(2) == 0) {  // thrown past p, and falls back
      p.velocity = p.acceleration = {};
      q.velocity = p.position - q.position + random.in_cube(0.2);
      q.acceleration = -random.uniform(0.3, 0.6) * q.velocity + random.in_cube(0.02);
    }
    const double distance = random.uniform(0.2, 3);
    most = std::max(most, static_cast<int>(LongDoublePair(p, q, distance).crossings(0.5, 12, 4000).size()));
    ASSERT_NO_FATAL_FAILURE(expect_crossings(p, q, distance, 12, "pair " + std::to_string(k)));
  }
  EXPECT_GE(most, 3) << "no pair came back";
}

TEST(PairMotion, QuadraticMotionHasUpToFourCrossings) {
  // There and back through the ball, along a line: x = 3 - 4 t + t^2 is within 0.5 twice.
  const FlightPlan p{}, q{0, {3, 0, 0}, {-4, 0, 0}, {2, 0, 0}};
  const PairMotion motion(p, q, {}, 0.5);
  const double expected[] = {2 - std::sqrt(1.5), 2 - std::sqrt(0.5), 2 + std::sqrt(0.5), 2 + std::sqrt(1.5)};
  double now = 0;
  bool is_within = false;
  for (const double crossing : expected) {
    now = motion.next_crossing(now, is_within);
    EXPECT_NEAR(now, crossing, 1e-14);
    is_within = !is_within;
  }
  EXPECT_EQ(motion.next_crossing(now, is_within), kNever);
}

TEST(PairMotion, TouchingIsNoCrossing) {
  const FlightPlan p{};
  const PairMotion passes(p, {0, {-3, 1, 0}, {1, 0, 0}, {}}, {}, 1);
  EXPECT_FALSE(passes.is_within_after(0));
  EXPECT_EQ(passes.next_crossing(0, false), kNever);
  // Up to the distance and back: x = 2 - 2 t + t^2 has its minimum 1 at t = 1.
  const PairMotion turns(p, {0, {2, 0, 0}, {-2, 0, 0}, {2, 0, 0}}, {}, 1);
  EXPECT_EQ(turns.next_crossing(0, false), kNever);
  // From within: x = 2 t - t^2 reaches 1 at t = 1, turns, and leaves on the other side.
  const PairMotion turns_within(p, {0, {0, 0, 0}, {2, 0, 0}, {-2, 0, 0}}, {}, 1);
  EXPECT_NEAR(turns_within.next_crossing(0, true), 1 + std::sqrt(2.0), 1e-14);
}

TEST(PairMotion, AtItsDistanceAPairCountsByWhereItIsGoing) {
  const FlightPlan p{0, {1.0 / 3, 0, 0}, {}, {}};
  const auto with = [&](Vec3 velocity, Vec3 acceleration) {
    return PairMotion(p, {0, {1.0 / 3 + 1, 0, 0}, velocity, acceleration}, {}, 1);
  };
  EXPECT_TRUE(with({-1, 0, 0}, {}).is_within_after(0));
  EXPECT_FALSE(with({1, 0, 0}, {}).is_within_after(0));
  EXPECT_FALSE(with({0, 1, 0}, {}).is_within_after(0));         // along the sphere, so off it
  EXPECT_TRUE(with({0, 1, 0}, {-2, 0, 0}).is_within_after(0));  // pulled in more than that
  EXPECT_FALSE(with({0, 0, 0}, {1, 0, 0}).is_within_after(0));
  EXPECT_TRUE(PairMotion({}, {0, {1, 0, 0}, {}, {}}, {}, 1).is_within_after(0));  // for good
  // It leaves at once if it was within, and does not come back.
  EXPECT_NEAR(with({1, 0, 0}, {}).next_crossing(0, true), 0, 1e-15);
  EXPECT_EQ(with({1, 0, 0}, {}).next_crossing(1e-9, false), kNever);
}

TEST(PairMotion, RoundingOfTimesIsAllowedFor) {
  // At a crossing long after the start the pair is off its distance by the rounding of the time.
  scenes::Random random(33);
  for (int k = 0; k < 2000; ++k) {
    const double start = std::pow(10, random.uniform(0, 6));
    FlightPlan q{start, random.in_cube(5), {}, {}};
    q.velocity = -1.0 * q.position + random.in_cube(0.3);
    const PairMotion motion({}, q, {}, 1);
    bool is_within = motion.is_within_after(start);
    for (double now = start; now < kNever;) {
      ASSERT_EQ(motion.is_within_after(now), is_within) << k << " at " << now;
      now = motion.next_crossing(now, is_within);
      is_within = !is_within;
    }
  }
}

TEST(PairMotion, FarAwayAndFast) {
  const PairMotion far({}, {0, {1e12, 0, 0}, {-1e6, 0, 0}, {}}, {}, 1);
  EXPECT_NEAR(far.next_crossing(0, false), 1e6 - 1e-6, 1e-9);
  EXPECT_NEAR(far.next_crossing(1e6, true), 1e6 + 1e-6, 1e-9);
  const PairMotion largest({}, {0, {kMaxMagnitude, 0, 0}, {-kMaxMagnitude, 0, 0}, {kMaxMagnitude, 0, 0}}, {},
                           1);
  EXPECT_EQ(largest.next_crossing(0, false), kNever);
  const PairMotion slow({}, {0, {2, 0, 0}, {}, {-1e-40, 0, 0}}, {}, 1);
  EXPECT_NEAR(slow.next_crossing(0, false) / std::sqrt(2e40), 1, 1e-14);
}

}  // namespace
}  // namespace dch::kinetic
