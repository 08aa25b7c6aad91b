// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/kinetic/kinetic_edges.hpp>

#include "error_message.hpp"
#include "scenes.hpp"
#include "special_numbers.hpp"

namespace dch::kinetic {
namespace {

using test::message_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

KineticParams with_cutoff(double cutoff, const Box& box = {}) {
  KineticParams params;
  params.box = box;
  params.cutoff = cutoff;
  return params;
}

TEST(KineticEdges, TellWhenAPairComesAndGoes) {
  const std::vector<FlightPlan> plans{{0, {-3, 0, 0}, {1, 0, 0}, {}}, {0, {0, 0, 0}, {}, {}}};
  auto engine = make_kinetic_edges(with_cutoff(1), plans, 0);
  EXPECT_LE(engine->next_event(), 2);
  std::vector<EdgeEvent> events;
  engine->advance_to(10, [&](const EdgeEvent& event) { events.push_back(event); });
  ASSERT_EQ(events.size(), 2U);
  EXPECT_TRUE(events[0].appears);
  EXPECT_EQ(events[0].time, 2);
  EXPECT_FALSE(events[1].appears);
  EXPECT_EQ(events[1].time, 4);
  EXPECT_EQ(engine->now(), 10);
  EXPECT_TRUE(engine->edges().empty());
}

TEST(KineticEdges, AStepStopsAtAnEventOrAtItsLimit) {
  const std::vector<FlightPlan> plans{{0, {-3, 0, 0}, {1, 0, 0}, {}}, {0, {0, 0, 0}, {}, {}}};
  auto engine = make_kinetic_edges(with_cutoff(1), plans, 0);
  EXPECT_FALSE(engine->step(1.5));
  EXPECT_EQ(engine->now(), 1.5);
  EXPECT_TRUE(engine->step(2));  // the limit belongs to it
  EXPECT_EQ(engine->now(), 2);
  EXPECT_THAT(engine->edges(), ElementsAre(Edge{0, 1}));
  EXPECT_FALSE(engine->step(2));
}

/// Two spheres that bounce off each other: their edge comes and goes at one time.
TEST(KineticEdges, APairThatTurnsAtItsDistanceLeavesAtOnce) {
  const std::vector<FlightPlan> plans{{0, {-3, 0, 0}, {1, 0, 0}, {}}, {0, {0, 0, 0}, {}, {}}};
  KineticParams params;
  params.radii = {0.7, 0.4};
  auto engine = make_kinetic_edges(params, plans, 0);
  const auto meet = engine->step(10);
  ASSERT_TRUE(meet);
  EXPECT_NEAR(meet->time, 1.9, 1e-15);
  engine->set_motion(0, {});
  engine->set_motion(1, {1, 0, 0});
  const auto part = engine->step(10);
  ASSERT_TRUE(part);
  EXPECT_FALSE(part->appears);
  EXPECT_EQ(part->time, meet->time);
  EXPECT_FALSE(engine->step(10));
}

TEST(KineticEdges, NoPointsOnePointAndPointsOnOneSpot) {
  auto none = make_kinetic_edges(with_cutoff(1), std::vector<FlightPlan>(), 0);
  EXPECT_FALSE(none->step(5));
  EXPECT_EQ(none->next_event(), kNever);
  auto one = make_kinetic_edges(with_cutoff(1), std::vector<FlightPlan>{{0, {}, {1, 0, 0}, {}}}, 0);
  EXPECT_FALSE(one->step(5));
  EXPECT_EQ(one->position(0), (Vec3{5, 0, 0}));
  auto spot = make_kinetic_edges(with_cutoff(1), std::vector<FlightPlan>(3), 0);
  EXPECT_THAT(spot->edges(), ElementsAre(Edge{0, 1}, Edge{0, 2}, Edge{1, 2}));
  spot->set_motion(1, {0, 0, 2});
  std::vector<Edge> left;
  spot->advance_to(1, [&](const EdgeEvent& event) { left.push_back(event.edge); });
  EXPECT_THAT(left, ElementsAre(Edge{0, 1}, Edge{1, 2}));
}

/// A lattice that shrinks towards the origin: all pairs of neighbors come within the distance at one time.
TEST(KineticEdges, ManyAtOneTimeComeInTheOrderOfTheirIds) {
  std::vector<FlightPlan> plans;
  for (const Vec3 p : scenes::fcc(Box::none(), 2 * std::sqrt(2.0), 200))
    plans.push_back({0, p, -0.25 * p, {}});
  auto engine = make_kinetic_edges(with_cutoff(std::sqrt(2.0)), plans, 0);
  std::vector<EdgeEvent> events;
  engine->advance_to(3, [&](const EdgeEvent& event) { events.push_back(event); });
  std::size_t neighbors = 0;
  for (std::size_t a = 0; a < plans.size(); ++a)
    for (std::size_t b = a + 1; b < plans.size(); ++b)
      neighbors += norm2(plans[a].position - plans[b].position) < 8.001;
  EXPECT_GE(events.size(), neighbors);
  for (std::size_t k = 1; k < events.size(); ++k) EXPECT_TRUE(events[k - 1] < events[k]);
  for (std::size_t k = 0; k < neighbors; ++k) EXPECT_NEAR(events[k].time, 2, 1e-12);
}

TEST(KineticEdges, OnePointFarAwayAndFast) {
  std::vector<FlightPlan> plans{{0, {1e12, 0, 0}, {-1e9, 0, 0}, {}}};
  for (int k = 0; k < 200; ++k) plans.push_back({0, {0, 3.0 * k, 0}, {}, {}});
  auto engine = make_kinetic_edges(with_cutoff(1), plans, 0);
  engine->advance_to(999.9999999);
  engine->set_motion(0, {-10, 0, 0});
  std::vector<EdgeEvent> events;
  engine->advance_to(1200, [&](const EdgeEvent& event) { events.push_back(event); });
  ASSERT_EQ(events.size(), 2U);
  EXPECT_NEAR(events[1].time - events[0].time, 0.2, 1e-9);
}

/// So that coordinates do not lose digits, however far points have come.
TEST(KineticEdges, PlansStartInTheCell) {
  const std::vector<FlightPlan> plans{{0, {-3, 5, 12}, {7, 0, 0}, {}}};
  auto engine = make_kinetic_edges(with_cutoff(1, Box::orthorhombic({10, 10, 10})), plans, 0);
  EXPECT_EQ(engine->plan(0).position, (Vec3{7, 5, 2}));
  engine->advance_to(2);
  EXPECT_EQ(engine->position(0), (Vec3{21, 5, 2}));
  engine->set_motion(0, {1, 0, 0});
  EXPECT_EQ(engine->plan(0).position, (Vec3{1, 5, 2}));
}

/// A drop sets the scale of the hierarchy, in which points of the gas around it stand on their own.
TEST(KineticEdges, APointThatFliesThroughThinGasMeetsAllOnItsWay) {
  std::vector<FlightPlan> plans{{0, {10, 0.5, 0}, {2, 0, 0}, {}}};
  for (const Vec3 p : scenes::uniform(600, {4, 4, 4}, 61))
    plans.push_back({0, p - Vec3{100, 100, 100}, {}, {}});
  for (int k = 1; k <= 40; ++k) plans.push_back({0, {50.0 * k, 0, 0}, {}, {}});
  auto engine = make_kinetic_edges(with_cutoff(1), plans, 0);
  std::vector<EdgeEvent> events;
  engine->advance_to(1100, [&](const EdgeEvent& event) { events.push_back(event); });
  ASSERT_EQ(events.size(), 80U);
  for (int k = 0; k < 40; ++k) {
    EXPECT_EQ(events[2 * k].edge, (Edge{0, 601 + k}));
    EXPECT_NEAR(events[2 * k].time, 25 * (k + 1) - 5 - 0.5 * std::sqrt(0.75), 1e-9);
  }
}

TEST(KineticEdges, RefuseParametersOutOfRange) {
  const auto refused = [](const KineticParams& params, const std::vector<FlightPlan>& plans, double start) {
    return message_of<Error>([&] { make_kinetic_edges(params, plans, start); });
  };
  const std::vector<FlightPlan> two(2);
  EXPECT_THAT(refused(with_cutoff(0), two, 0), HasSubstr("cutoff = 0"));
  EXPECT_THAT(refused(with_cutoff(kNaN), two, 0), HasSubstr("nan"));
  KineticParams params;
  params.radii = {1};
  EXPECT_THAT(refused(params, two, 0), HasSubstr("1 radii for 2 points"));
  params.radii = {1, -1};
  EXPECT_THAT(refused(params, two, 0), HasSubstr("radius of point 1 = -1"));
  EXPECT_THAT(refused(with_cutoff(4.6, Box::orthorhombic({10, 10, 10})), two, 0),
              AllOf(HasSubstr("4.6"), HasSubstr("4.5"), HasSubstr("replicate")));
  EXPECT_THAT(refused(with_cutoff(1), {{1, {}, {}, {}}}, 0), HasSubstr("time of the plan of point 0 = 1"));
  EXPECT_THAT(refused(with_cutoff(1), {{0, {kNaN, 0, 0}, {}, {}}}, 0), HasSubstr("position of the plan"));
  EXPECT_THAT(refused(with_cutoff(1), {{0, {}, {kNaN, 0, 0}, {}}}, 0), HasSubstr("velocity of point 0"));
  EXPECT_THAT(refused(with_cutoff(1), {{0, {}, {}, {1e60, 0, 0}}}, 0), HasSubstr("acceleration of point 0"));
  EXPECT_THAT(refused(with_cutoff(1), {{kNaN, {}, {}, {}}}, 0), HasSubstr("time of the plan"));
  EXPECT_THAT(refused(with_cutoff(1), two, kNaN), HasSubstr("start = nan"));
}

TEST(KineticEdges, RefuseTimeThatRunsBackAndChangeNothing) {
  auto engine = make_kinetic_edges(with_cutoff(1), std::vector<FlightPlan>(2), 0);
  engine->advance_to(2);
  EXPECT_THAT(message_of<InvalidParameter>([&] { engine->advance_to(1); }),
              AllOf(HasSubstr("time = 1"), HasSubstr("before now, 2"), HasSubstr("start anew")));
  EXPECT_THAT(message_of<InvalidParameter>([&] { engine->advance_to(kNaN); }), HasSubstr("nan"));
  EXPECT_THAT(message_of<InvalidParameter>([&] { engine->set_motion(2, {}); }), HasSubstr("0..1"));
  EXPECT_THAT(message_of<InvalidParameter>([&] { engine->set_motion(-1, {}); }), HasSubstr("point -1"));
  EXPECT_THAT(message_of<InvalidParameter>([&] { engine->set_motion(0, {kNaN, 0, 0}); }), HasSubstr("nan"));
  EXPECT_EQ(engine->now(), 2);
  EXPECT_EQ(engine->plan(0).velocity, Vec3{});
}

}  // namespace
}  // namespace dch::kinetic
