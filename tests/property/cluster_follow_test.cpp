// SPDX-License-Identifier: MIT
//
// Cluster pairs that follow particles from where they were found, and tell who has left.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <dch/base/executor.hpp>

#include "cluster_pair_check.hpp"
#include "instruction_sets.hpp"
#include "list_params.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kFollowRadius = 1.0;

class ClusterFollowScenes : public ::testing::TestWithParam<scenes::NamedBox> {};

/// Where the particles of pairs stand, and the lattice vectors that bring positions there.
ClusterPairs::Places places_of(const ClusterPairs& pairs, const std::vector<Vec3>& positions) {
  ClusterPairs::Places places{pairs.at, {}, {}};
  for (std::size_t c = 0; c < pairs.at.size(); ++c) {
    ClusterOfFour<double> shift;
    double largest = 0;
    for (int slot = 0; slot < 4; ++slot) {
      const std::int32_t i = pairs.particle[4 * c + static_cast<std::size_t>(slot)];
      const Vec3 at{pairs.at[c].x[slot], pairs.at[c].y[slot], pairs.at[c].z[slot]};
      const Vec3 by = pairs.origin[static_cast<std::size_t>(pairs.origin_of[c])] + at -
                      positions[static_cast<std::size_t>(i < 0 ? pairs.particle[4 * c] : i)];
      shift.x[slot] = by.x, shift.y[slot] = by.y, shift.z[slot] = by.z;
      largest = std::max(largest, norm2(by));
    }
    places.shift_of.push_back(largest < 0.1 ? -1 : static_cast<std::int32_t>(places.shift.size()));
    if (largest >= 0.1) places.shift.push_back(shift);
  }
  return places;
}

/// The largest distance of a slot in one from the same in the other, in double or single precision.
double difference(const ClusterPairs& a, const ClusterPairs& b) {
  double largest = std::abs(a.unit - b.unit);
  const auto apart = [&](std::int32_t r, std::int32_t s) {
    return a.unit * std::remainder(static_cast<double>(r) - static_cast<double>(s), 0x1p32);
  };
  for (std::size_t c = 0; c < a.at.size(); ++c)
    for (int slot = 0; slot < 4; ++slot) {
      const auto &p = a.at[c], &q = b.at[c];
      const auto &r = a.at_in_units[c], &s = b.at_in_units[c];
      for (const double by :
           {p.x[slot] - q.x[slot], p.y[slot] - q.y[slot], p.z[slot] - q.z[slot], apart(r.x[slot], s.x[slot]),
            apart(r.y[slot], s.y[slot]), apart(r.z[slot], s.z[slot])})
        largest = std::max(largest, std::abs(by));
    }
  return largest;
}

// Of particles that wander from the places at which they were found, a few of them far.
TEST_P(ClusterFollowScenes, FollowGivesWhatRefreshGivesAndNamesWhoIsAway) {
  const Box box = GetParam().box;
  const RestoreInstructionSet restore;
  scenes::Random random(13);
  std::vector<Vec3> points = scenes::uniform_in(box, 400, 5);
  for (std::size_t i = 0; i < points.size(); i += 5)
    for (int axis = 0; axis < 3; ++axis)
      if (box.periodic(axis))
        points[i] = points[i] + (static_cast<double>(random.below(5)) - 2) * box.vector(axis);
  ListedHierarchy hierarchy = hierarchy_of(points, box, kFollowRadius);
  ClusterPairs found;
  hierarchy.cluster_pairs(within(kFollowRadius), found);
  const ClusterPairs::Places places = places_of(found, points);
  std::vector<Vec3> moved = points;
  std::vector<bool> is_away(points.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Vec3 step = random.in_ball(1);
    is_away[i] = i % 40 == 7;
    moved[i] =
        moved[i] + ((is_away[i] ? 0.31 : 0.29 * std::sqrt(norm2(step))) / std::sqrt(norm2(step))) * step;
  }
  std::vector<std::int32_t> expected;
  for (std::size_t k = 0; k < found.particle.size(); ++k) {
    const auto cluster = static_cast<std::int32_t>(k / 4);
    if (found.particle[k] < 0 || !is_away[static_cast<std::size_t>(found.particle[k])]) continue;
    if (expected.empty() || expected.back() != cluster) expected.push_back(cluster);
  }
  ASSERT_GT(expected.size(), 3u);
  ClusterPairs refreshed = found;
  refreshed.refresh(moved, box);
  const auto pool = make_thread_pool(3);
  for (const InstructionSet set : supported_sets())
    for (Executor* const executor : {static_cast<Executor*>(nullptr), pool.get()}) {
      set_instruction_set(set);
      ClusterPairs pairs = found;
      std::vector<std::int32_t> away{1, 2, 3};
      ASSERT_TRUE(pairs.follow(places, moved, box, 0.3, away, executor));
      EXPECT_EQ(away, expected) << set;
      EXPECT_LT(difference(pairs, refreshed), 1e-6) << set;
      EXPECT_EQ(cluster_pair_fault(pairs, moved, box, within(kFollowRadius - 0.7)), "") << set;
      for (const double x :
           {std::nan(""), points[0].x + 0.4 * (box.any_periodic() ? box.min_height() : 1 / 0.0)}) {
        const auto i = static_cast<std::size_t>(found.particle[0]);
        std::vector<Vec3> lost = moved;
        lost[i].x = std::isnan(x) ? x : lost[i].x + x - points[0].x;
        EXPECT_FALSE(pairs.follow(places, lost, box, 0.3, away, executor)) << set;
        EXPECT_EQ(away.front(), 0);
        pairs.refresh(moved, box);
        EXPECT_LT(difference(pairs, refreshed), 1e-6) << set;
      }
    }
}

// What a barostat does: another shape of the cell is tried, and the one of the search comes back.
TEST_P(ClusterFollowScenes, FollowTakesTheBoxOfTheSearchBack) {
  const Box box = GetParam().box;
  if (!box.any_periodic()) return;
  const std::vector<Vec3> points = scenes::uniform_in(box, 400, 5);
  ListedHierarchy hierarchy = hierarchy_of(points, box, kFollowRadius);
  ClusterPairs pairs;
  hierarchy.cluster_pairs(within(kFollowRadius), pairs);
  const ClusterPairs::Places places = places_of(pairs, points);
  const Box tried = Box::triclinic(1.01 * box.vector(0), 1.01 * box.vector(1), 1.01 * box.vector(2),
                                   {box.periodic(0), box.periodic(1), box.periodic(2)}, box.origin());
  std::vector<Vec3> scaled;
  for (const Vec3 p : points) scaled.push_back(scenes::from_fractional(tried, box.fractional(p)));
  pairs.refresh(scaled, tried);
  std::vector<std::int32_t> away;
  ASSERT_TRUE(pairs.follow(places, points, box, 0.01, away));
  EXPECT_TRUE(away.empty());
  EXPECT_EQ(cluster_pair_fault(pairs, points, box, within(kFollowRadius)), "");
}

INSTANTIATE_TEST_SUITE_P(Boxes, ClusterFollowScenes, ::testing::ValuesIn(scenes::all_boxes(5.0)),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace dch
