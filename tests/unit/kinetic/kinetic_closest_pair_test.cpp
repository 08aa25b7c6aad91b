// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/kinetic/kinetic_closest_pair.hpp>

#include "error_message.hpp"
#include "random.hpp"

namespace dch::kinetic {
namespace {

using Plans = std::vector<FlightPlan>;

FlightPlan at_rest(Vec3 at) { return {0, at, {}, {}}; }

TEST(KineticClosestPair, OfFewerThanTwoPointsThereIsNone) {
  for (const Plans& plans : {Plans{}, Plans{at_rest({1, 2, 3})}}) {
    KineticClosestPair closest(Box::none(), plans, 0);
    EXPECT_EQ(closest.pair(), Edge());
    EXPECT_EQ(closest.distance(), kNever);
    EXPECT_EQ(closest.step(10), std::nullopt);
    EXPECT_EQ(closest.now(), 10);
  }
}

/// 0 and 1 are a unit apart. 2 comes to 3 from 10 away at a speed of 2, passes it at a third of a unit, and
/// flies on.
TEST(KineticClosestPair, ChangesWhereTheDistancesAreEqual) {
  const double height = 1.0 / 3, leg = std::sqrt(1 - height * height);
  const Plans plans{
      at_rest({0, 0, 0}), at_rest({1, 0, 0}), {0, {50, height, 0}, {2, 0, 0}, {}}, at_rest({60, 0, 0})};
  KineticClosestPair closest(Box::none(), plans, 0);
  EXPECT_EQ(closest.pair(), (Edge{0, 1}));
  EXPECT_EQ(closest.distance(), 1);
  auto change = closest.step(100);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->before, (Edge{0, 1}));
  EXPECT_EQ(change->after, (Edge{2, 3}));
  EXPECT_NEAR(change->time, 5 - leg / 2, 1e-12);
  EXPECT_EQ(closest.now(), change->time);
  change = closest.step(100);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->after, (Edge{0, 1}));
  EXPECT_NEAR(change->time, 5 + leg / 2, 1e-12);
  EXPECT_EQ(closest.step(100), std::nullopt);
  EXPECT_GT(closest.next_event(), 100);
}

/// 2 passes 3 at the very distance of 0 and 1.
TEST(KineticClosestPair, PairsThatAreAsCloseForAMomentHaveNoEvent) {
  const Plans plans{
      at_rest({0, 0, 0}), at_rest({1, 0, 0}), {0, {4, 1, 0}, {2, 0, 0}, {}}, at_rest({6, 0, 0})};
  KineticClosestPair closest(Box::none(), plans, 0);
  EXPECT_EQ(closest.step(100), std::nullopt);
  EXPECT_EQ(closest.pair(), (Edge{0, 1}));
}

/// Sites of a lattice that flies as a whole.
TEST(KineticClosestPair, OfPairsThatAreAsCloseForGoodTheSmallestIdsAreMeant) {
  Plans plans;
  for (int k = 0; k < 64; ++k)
    plans.push_back({0, {1.0 * (k % 4), 1.0 * (k / 4 % 4), 1.0 * (k / 16)}, {0.5, 0.25, 1}, {}});
  KineticClosestPair closest(Box::none(), plans, 0);
  EXPECT_EQ(closest.pair(), (Edge{0, 1}));
  EXPECT_EQ(closest.step(64), std::nullopt);
  closest.set_motion(63, {0, 0, 0});  // from now on it leaves its three neighbors, and then passes others
  EXPECT_EQ(closest.pair(), (Edge{0, 1}));
}

/// The nearest image changes, the pair does not.
TEST(KineticClosestPair, OfTwoPointsIsThatOfTheirNearestImages) {
  const Box box = Box::orthorhombic({4, 4, 4});
  const Plans plans{at_rest({0, 0, 0}), {0, {1, 2, 2}, {1, 0, 0}, {}}};
  KineticClosestPair closest(box, plans, 0);
  for (int k = 1; k <= 20; ++k) {
    EXPECT_EQ(closest.step(0.5 * k), std::nullopt);
    EXPECT_EQ(closest.pair(), (Edge{0, 1}));
    EXPECT_NEAR(closest.distance(), std::sqrt(box.distance2({0, 0, 0}, {1 + 0.5 * k, 2, 2})), 1e-12);
  }
  EXPECT_GT(closest.counters().looks_ahead, 1);
}

TEST(KineticClosestPair, ACutoffIsEnlargedWhenPointsFlyApart) {
  Plans plans;
  scenes::Random random(75);
  for (int k = 0; k < 40; ++k) {
    const Vec3 at = random.in_cube(1);
    plans.push_back({0, at, at + 0.1 * random.in_cube(1), {}});
  }
  KineticClosestPair closest(Box::none(), plans, 0);
  const double before = closest.cutoff();
  closest.advance_to(1e6);
  EXPECT_GT(closest.cutoff(), 1e4 * before);
  EXPECT_GE(closest.counters().edges, 1);
  EXPECT_LT(closest.counters().cutoffs, 40);
}

/// They meet in the middle, all at once.
TEST(KineticClosestPair, ACutoffIsMadeSmallerWhenPointsCrowd) {
  Plans plans;
  scenes::Random random(76);
  for (int k = 0; k < 200; ++k) {
    const Vec3 at = random.in_cube(100);
    plans.push_back({0, at, -1.0 * at, {}});
  }
  KineticClosestPair closest(Box::none(), plans, 0);
  closest.advance_to(0.9999);
  EXPECT_LE(closest.counters().edges, 64 + 8 * 200);
  EXPECT_LT(closest.cutoff(), 0.02);
}

TEST(KineticClosestPair, CountsItsQualities) {
  for (const int points : {100, 400, 1600}) {
    scenes::Random random(77);
    const double side = std::cbrt(points);
    Plans plans;
    for (int k = 0; k < points; ++k) plans.push_back({0, random.in_cube(side), random.in_cube(1), {}});
    KineticClosestPair closest(Box::orthorhombic({side, side, side}), plans, 0);
    const ClosestCounters before = closest.counters();
    closest.advance_to(2);
    const ClosestCounters after = closest.counters();
    const double height = std::log2(static_cast<double>(after.edges)) + 2;
    EXPECT_LT(after.edges, points);  // compact
    EXPECT_LT(after.certificates, after.edges);
    const auto events = after.lost + after.edge_events - before.lost - before.edge_events;
    EXPECT_GT(events, points / 2);
    EXPECT_LE(static_cast<double>(after.made - before.made),
              1.5 * height * static_cast<double>(events));  // responsive
    for (std::int32_t id = 0; id < points; ++id)
      EXPECT_LE(static_cast<double>(closest.certificates_of(id)), 6 * height);  // local
  }
}

template <class Call>
void expect_message(const Call& call, const std::string& part) {
  const std::string message = test::message_of<Error>(call);
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(KineticClosestPair, RefusesWhatDoesNotFit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Plans plans{at_rest({0, 0, 0}), at_rest({1, 0, 0})};
  KineticClosestPair closest(Box::none(), plans, 0);
  closest.step(2);
  expect_message([&] { closest.step(1); }, "time = 1 is before now, 2");
  expect_message([&] { closest.step(nan); }, "time = ");
  expect_message([&] { closest.set_motion(2, {}); }, "point 2 is not within 0..1");
  expect_message([&] { closest.set_motion(0, {nan, 0, 0}); }, "velocity of point 0");
  EXPECT_EQ(closest.step(3), std::nullopt);  // as if nothing had been
  expect_message([&] { KineticClosestPair(Box::none(), Plans{at_rest({nan, 0, 0})}, 0); }, "position");
  expect_message([&] { KineticClosestPair(Box::none(), Plans{{1, {}, {}, {}}}, 0); }, "after the start");
  expect_message([&] { KineticClosestPair(Box::none(), plans, nan); }, "start");
}

}  // namespace
}  // namespace dch::kinetic
