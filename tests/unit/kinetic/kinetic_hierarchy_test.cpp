// SPDX-License-Identifier: MIT
//
// The kinetic DCH on the thesis's own scenes, at ties, and where its top has to grow.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include <dch/kinetic/kinetic_hierarchy.hpp>

#include "scenes.hpp"

namespace dch::kinetic {
namespace {

KineticParams hierarchy_cutoff(double cutoff, const Box& box = {}) {
  KineticParams params;
  params.box = box;
  params.cutoff = cutoff;
  return params;
}

/// Steps to the end, and expects a valid structure after every event, inside or outside.
std::vector<EdgeEvent> run_valid(KineticHierarchy& hierarchy, double end) {
  std::vector<EdgeEvent> events;
  EXPECT_EQ(hierarchy.validate(), "");
  while (hierarchy.next_event() <= end) {
    if (const auto event = hierarchy.step(hierarchy.next_event())) events.push_back(*event);
    const std::string fault = hierarchy.validate();
    EXPECT_EQ(fault, "") << "at " << hierarchy.now();
    if (!fault.empty()) break;
  }
  hierarchy.advance_to(end);
  return events;
}

/// Fig. 5.1 and 5.2: m bumps pass over m others. Beads of a bump are 1 apart, its peak passes the other peak
/// at a gap of 0.4: less than half the bond, so that peaks alone come near each other.
std::vector<FlightPlan> passing_bumps(int bumps) {
  std::vector<FlightPlan> plans;
  for (int k = 0; k < bumps; ++k)
    for (int bead = 0; bead < 3; ++bead) {
      plans.push_back({0, {6.0 * k, -1.0 * bead, 0}, {}, {}});
      plans.push_back({0, {6.0 * (k + bumps) - 2, 0.4 + bead, 0}, {-1, 0, 0}, {}});
    }
  return plans;
}

TEST(KineticHierarchy, EachBumpThatPassesAnotherIsAnEventOfTheLevels) {
  for (const int bumps : {2, 4, 6}) {
    const std::vector<FlightPlan> plans = passing_bumps(bumps);
    auto hierarchy = make_kinetic_hierarchy(hierarchy_cutoff(1.25), plans, 0);  // R_0 = 0.5
    const std::vector<EdgeEvent> edges = run_valid(*hierarchy, 12.0 * bumps + 10);
    // A peak of level 1 comes within R_0 of the other's, and leaves it again.
    EXPECT_GE(hierarchy->counters().demotions, bumps * bumps);
    EXPECT_GE(hierarchy->counters().lost_parents, bumps * bumps);
    EXPECT_GE(static_cast<int>(edges.size()), 2 * bumps * bumps);
  }
}

/// Fig. 5.5: an upper row moves along a lower one, so that one pair after the other is matched. After the
/// start there are m (m + 1) / 2 - 1 of them.
TEST(KineticHierarchy, RowsThatAreShiftedMatchOnePairAfterTheOther) {
  constexpr double kGap = 4;
  for (const int m : {2, 3, 5}) {
    std::vector<FlightPlan> plans;
    for (int j = 0; j < m; ++j) {
      plans.push_back({0, {kGap * j * m, 0, 0}, {}, {}});
      plans.push_back({0, {kGap * j * (m - 1), 1, 0}, {1, 0, 0}, {}});
    }
    auto hierarchy = make_kinetic_hierarchy(hierarchy_cutoff(1.25), plans, 0);
    EXPECT_EQ(hierarchy->edges().size(), 1U);
    std::size_t matched = 0;
    for (const EdgeEvent& event : run_valid(*hierarchy, kGap * m * m)) matched += event.appears;
    EXPECT_EQ(matched, static_cast<std::size_t>(m * (m + 1) / 2 - 1));
  }
}

/// Theorem 5.5.1: a pair crosses each of the distances R_i and rho_i at most twice under linear motion.
TEST(KineticHierarchy, EventsAreBoundedByThePairsTimesTheLevels) {
  scenes::Random random(51);
  for (int scene = 0; scene < 5; ++scene) {
    std::vector<FlightPlan> plans;
    for (int k = 0; k < 60; ++k) plans.push_back({0, random.in_cube(10), random.in_cube(1), {}});
    auto hierarchy = make_kinetic_hierarchy(hierarchy_cutoff(1), plans, 0);
    const int levels_before = hierarchy->levels();
    hierarchy->advance_to(40);
    EXPECT_EQ(hierarchy->validate(), "");
    const std::int64_t distances = 2 * std::max(levels_before, hierarchy->levels()) + 1;
    EXPECT_GT(hierarchy->counters().events(), 500);
    EXPECT_LE(hierarchy->counters().events(), 60 * 59 * distances);
  }
}

/// Growth at the root, and the way back: points fly apart, and others fly together.
TEST(KineticHierarchy, GrowsAndShrinksAtTheRoot) {
  scenes::Random random(52);
  std::vector<FlightPlan> plans;
  for (int k = 0; k < 15; ++k) {
    const Vec3 p = random.in_cube(1);
    plans.push_back({0, p, 100.0 * p, {}});
  }
  auto hierarchy = make_kinetic_hierarchy(hierarchy_cutoff(0.5), plans, 0);
  const int before = hierarchy->levels();
  run_valid(*hierarchy, 10);
  const int grown = hierarchy->levels();
  EXPECT_GE(grown, before + 8);
  for (int id = 0; id < 15; ++id) hierarchy->set_motion(id, -100.0 * plans[id].position);
  run_valid(*hierarchy, 20.001);
  EXPECT_LE(hierarchy->levels(), before + 1);
  EXPECT_GE(hierarchy->counters().demotions, grown - before);
}

/// All distances between neighbors pass all thresholds of the levels at the same times.
TEST(KineticHierarchy, ALatticeThatShrinksStaysValid) {
  std::vector<FlightPlan> plans;
  for (const Vec3 p : scenes::fcc(Box::none(), std::sqrt(2.0))) plans.push_back({0, p, -0.125 * p, {}});
  auto hierarchy = make_kinetic_hierarchy(hierarchy_cutoff(std::sqrt(0.5)), plans, 0);
  auto engine = make_kinetic_edges(hierarchy_cutoff(std::sqrt(0.5)), plans, 0);
  const std::vector<EdgeEvent> events = run_valid(*hierarchy, 7.5);
  EXPECT_EQ(events.size(), plans.size() * (plans.size() - 1) / 2)
      << "each pair comes within the cutoff, and none leaves it";
  for (const EdgeEvent& event : events) {
    const auto found = engine->step(7.5);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->edge, event.edge);
    EXPECT_EQ(found->time, event.time);
  }
  EXPECT_FALSE(engine->step(7.5));
}

TEST(KineticHierarchy, OnePointFarAwayComesBack) {
  scenes::Random random(53);
  std::vector<FlightPlan> plans{{0, {1e12, 0, 0}, {-1e6, 0, 0}, {}}};
  for (int k = 0; k < 20; ++k) plans.push_back({0, random.in_cube(2), {}, {}});
  auto hierarchy = make_kinetic_hierarchy(hierarchy_cutoff(1), plans, 0);
  EXPECT_GE(hierarchy->levels(), 40);
  EXPECT_EQ(run_valid(*hierarchy, 1e6 - 1).size(), 0U);
  EXPECT_LE(hierarchy->levels(), 24);
  EXPECT_GE(run_valid(*hierarchy, 1e6 + 1).size(), 2U);
}

TEST(KineticHierarchy, NoPointsOnePointAndPointsOnOneSpot) {
  auto none = make_kinetic_hierarchy(hierarchy_cutoff(1), std::vector<FlightPlan>(), 0);
  EXPECT_TRUE(run_valid(*none, 1).empty());
  auto one = make_kinetic_hierarchy(hierarchy_cutoff(1), std::vector<FlightPlan>{{0, {}, {1, 0, 0}, {}}}, 0);
  EXPECT_TRUE(run_valid(*one, 1).empty());
  EXPECT_EQ(one->levels(), 1);
  auto spot = make_kinetic_hierarchy(hierarchy_cutoff(1), std::vector<FlightPlan>(4), 0);
  EXPECT_EQ(spot->edges().size(), 6U);
  EXPECT_EQ(spot->levels(), 2);
  spot->set_motion(3, {0, 0, 2});
  EXPECT_EQ(run_valid(*spot, 2).size(), 3U);
  EXPECT_EQ(spot->parent(0, 0), spot->parent(1, 0));
}

/// The qualities of a kinetic data structure (5.5.2), as counted: certificates grow as the points, an event
/// makes few of them, a point has part in few, and most events are those of edges.
TEST(KineticHierarchy, CountsItsQualities) {
  const auto counted = [&](std::size_t points) {
    const double side = 8 * std::cbrt(static_cast<double>(points) / 100);
    const Box wide = Box::orthorhombic({side, side, side});
    scenes::Random random(54);
    std::vector<FlightPlan> plans;
    for (const Vec3 p : scenes::uniform_in(wide, points, 55)) plans.push_back({0, p, random.in_cube(1), {}});
    auto hierarchy = make_kinetic_hierarchy(hierarchy_cutoff(1.5, wide), plans, 0);
    hierarchy->advance_to(0.3);
    EXPECT_EQ(hierarchy->validate(), "");
    return hierarchy;
  };
  const auto small = counted(100), large = counted(400);
  const KineticCounters few = small->counters(), many = large->counters();
  EXPECT_LE(many.most_certificates, 400 * 400);
  EXPECT_LE(many.most_certificates, 12 * few.most_certificates);
  EXPECT_LE(many.most_made_by_one, 3000);
  EXPECT_GT(many.external, 100);
  for (std::int32_t id = 0; id < 400; ++id) EXPECT_LE(large->certificates_of(id), 1500);
}

}  // namespace
}  // namespace dch::kinetic
