// SPDX-License-Identifier: MIT
//
// Contacts between two frames, against all pairs in long double and against the events of points that move:
// in every box, that stays or changes, with displacements up to half of it.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include <dch/kinetic/contacts_between.hpp>
#include <dch/kinetic/kinetic_edges.hpp>

#include "contacts_between_check.hpp"
#include "effort.hpp"
#include "scenes.hpp"

namespace dch::kinetic {
namespace {

constexpr double kSlack = 1e-9;

/// Two frames of random points, some of which stand, most move a little, and some far.
struct TwoFrames {
  TwoFrames(std::uint64_t seed, bool box_changes) : random(seed) {
    const auto boxes = scenes::all_boxes(5);
    const std::size_t kind = random.below(boxes.size());
    before = after = boxes[kind].box;
    if (box_changes && before.kind() != Box::Kind::none) after = changed(before);
    what = "seed " + std::to_string(seed) + ", " + boxes[kind].name;
    const double limit = std::min({before.max_cutoff(), after.max_cutoff(), 2.5});
    cutoff = limit * (random.below(4) == 0 ? 1 : random.uniform(0.1, 1));
    start = scenes::uniform_in(before, 2 + random.below(60), seed + 1);
    const double step = limit * std::pow(10, random.uniform(-3, 0));
    for (std::size_t k = 0; k < start.size(); ++k) {
      const double way = random.below(6) == 0 ? 0 : random.below(6) == 0 ? 0.9 * limit : step;
      Vec3 to = random.in_ball(way);
      to = to + scenes::from_fractional(after, before.fractional(start[k]));
      if (before.kind() == Box::Kind::none) to = start[k] + random.in_ball(way);
      // Any images, and what wrapping makes of them.
      if (random.below(3) == 0) start[k] = shifted(before, start[k]);
      if (random.below(3) == 0) to = shifted(after, to);
      end.push_back(to);
    }
  }

  Box changed(const Box& box) {
    Vec3 cell[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 v = box.vector(axis);
      for (int k = 0; k < 3; ++k) cell[axis][k] = v[k];
    }
    const bool axes = box.kind() == Box::Kind::orthorhombic && random.below(2) == 0;
    const double strain = std::pow(10, random.uniform(-6, -1.7));
    Vec3 rows[3];
    for (int k = 0; k < 3; ++k) {
      rows[k] = axes ? Vec3{} : strain * random.in_cube(1);
      rows[k][k] = strain * random.uniform(-1, 1);
    }
    // Open axes stay normal to the periodic ones, or next to it.
    for (Vec3& v : cell) v = v + Vec3{dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
    const Box::Periodic periodic{box.periodic(0), box.periodic(1), box.periodic(2)};
    if (random.below(2) == 0 && periodic[0] && periodic[1]) cell[1] = cell[1] - cell[0];  // a flip
    return Box::triclinic(cell[0], cell[1], cell[2], periodic, box.origin() + random.in_cube(0.3));
  }
  Vec3 shifted(const Box& box, Vec3 p) {
    for (int axis = 0; axis < 3; ++axis)
      if (box.periodic(axis)) p = p + (static_cast<double>(random.below(7)) - 3) * box.vector(axis);
    return p;
  }

  scenes::Random random;
  std::string what;
  Box before, after;
  double cutoff = 1;
  std::vector<Vec3> start, end;
};

void check_scenes(std::uint64_t seed, int scenes, bool box_changes, std::size_t least_hidden) {
  std::size_t hidden = 0, undetermined = 0;
  const std::string engines[] = {"auto", "dch", "grid", "cell"};
  for (int k = 0; k < scenes && !testing::Test::HasFailure(); ++k) {
    const TwoFrames frames(seed + 10 * static_cast<std::uint64_t>(k), box_changes);
    SCOPED_TRACE(frames.what);
    ContactsBetween between(frames.cutoff, engines[k % 4]);
    const PassingContacts& found = between.find(frames.start, frames.before, frames.end, frames.after);
    ASSERT_EQ(found.undetermined, "");
    undetermined += found.undetermined_points.size();
    hidden += check_contacts_between(found, frames.cutoff, kSlack, frames.start, frames.before, frames.end,
                                     frames.after);
  }
  EXPECT_GT(hidden, least_hidden);
  std::printf("%zu hidden contacts, %zu undetermined points\n", hidden, undetermined);
}

TEST(ContactsBetweenFrames, AreThoseOfAllPairsInEveryBox) {
  check_scenes(5100000, effort(1500), false, static_cast<std::size_t>(effort(1500)));
}

TEST(ContactsBetweenFrames, AreThoseOfAllPairsWhereTheBoxChanges) {
  check_scenes(5200000, effort(1500), true, static_cast<std::size_t>(effort(1500)));
}

/// The events of make_kinetic_edges() for the same motion make up the same contacts.
TEST(ContactsBetweenFrames, AreThoseOfTheEventsOfMovingPoints) {
  std::size_t events = 0;
  for (int k = 0; k < effort(600); ++k) {
    TwoFrames frames(5300000 + 10 * static_cast<std::uint64_t>(k), false);
    SCOPED_TRACE(frames.what);
    KineticParams params;
    params.box = frames.before;
    params.cutoff = std::min(frames.cutoff, 0.89 * frames.before.max_cutoff());
    ContactsBetween between(params.cutoff);
    const PassingContacts& found = between.find(frames.start, frames.before, frames.end, frames.after);
    if (!found.undetermined_points.empty()) continue;
    std::vector<FlightPlan> plans;
    for (std::size_t i = 0; i < frames.start.size(); ++i)
      plans.push_back({0, frames.start[i], frames.before.nearest_image(frames.end[i] - frames.start[i]), {}});
    const auto edges = make_kinetic_edges(params, plans, 0);
    std::map<PairOfPoints, std::vector<double>> expected, told;
    edges->advance_to(1, [&](const EdgeEvent& event) {
      expected[{event.edge.a, event.edge.b}].push_back(event.time);
      ++events;
    });
    for (const PassingContact& contact : found.contacts) {
      auto& times = told[{contact.i, contact.j}];
      if (!contact.is_shown_before) times.push_back(contact.enters);
      if (!contact.is_shown_after) times.push_back(contact.leaves);
    }
    ASSERT_EQ(told.size(), expected.size());
    for (const auto& [pair, times] : expected) {
      ASSERT_EQ(told[pair].size(), times.size()) << pair.first << ", " << pair.second;
      for (std::size_t n = 0; n < times.size(); ++n) ASSERT_NEAR(told[pair][n], times[n], 1e-7);
    }
  }
  EXPECT_GT(events, static_cast<std::size_t>(effort(4000)));
}

/// One object over many intervals gives what a new one gives, on any number of threads.
TEST(ContactsBetweenFrames, DependNeitherOnHistoryNorOnThreads) {
  const auto pool = make_thread_pool(3);
  scenes::Random random(54);
  const Box box = Box::orthorhombic({9, 9, 9});
  std::vector<Vec3> now = scenes::uniform_in(box, 700, 55);
  ContactsBetween kept(0.7, "dch", pool.get());
  for (int step = 0; step < 20; ++step) {
    std::vector<Vec3> next = now;
    const double way = step % 5 == 4 ? 3 : 0.2;
    for (Vec3& p : next) p = p + random.in_ball(way);
    const PassingContacts& found = kept.find(now, box, next, box);
    ContactsBetween fresh(0.7, "grid");
    const PassingContacts& expected = fresh.find(now, box, next, box);
    ASSERT_EQ(found.contacts.size(), expected.contacts.size());
    for (std::size_t k = 0; k < found.contacts.size(); ++k) {
      const PassingContact &a = found.contacts[k], &b = expected.contacts[k];
      ASSERT_TRUE(a.i == b.i && a.j == b.j && a.closest == b.closest);
      ASSERT_TRUE(a.enters == b.enters && a.leaves == b.leaves);
    }
    now = next;
  }
}

}  // namespace
}  // namespace dch::kinetic
