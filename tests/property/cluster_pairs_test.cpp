// SPDX-License-Identifier: MIT
//
// Cluster pairs hold every pair once, with the right image, in every kind of box, and still do after motion.
#include <gtest/gtest.h>
#include <string>
#include <tuple>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>

#include "cluster_pair_check.hpp"
#include "error_message.hpp"
#include "instruction_sets.hpp"
#include "list_params.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kRadius = 1.0;

class ClusterPairsScenes : public ::testing::TestWithParam<scenes::NamedBox> {};

/// Entry by entry; images and masks included.
bool same(const ClusterPairs& a, const ClusterPairs& b) {
  const auto same_entry = [](const ClusterPairs::Entry& p, const ClusterPairs::Entry& q) {
    return p.cluster == q.cluster && p.mask == q.mask && p.shift == q.shift;
  };
  const auto same_row = [](const ClusterPairs::Row& p, const ClusterPairs::Row& q) {
    return p.first == q.first && p.cluster == q.cluster && p.first_shift == q.first_shift;
  };
  const auto same_shift = [](const ClusterPairs::Shift& p, const ClusterPairs::Shift& q) {
    return p.from == q.from && p.to == q.to && p.image == q.image;
  };
  return a.particle == b.particle &&
         std::equal(a.entries.begin(), a.entries.end(), b.entries.begin(), b.entries.end(), same_entry) &&
         std::equal(a.rows.begin(), a.rows.end(), b.rows.begin(), b.rows.end(), same_row) &&
         std::equal(a.shift.begin(), a.shift.end(), b.shift.begin(), b.shift.end(), same_shift);
}

template <class Places>
std::string bits_of(const std::vector<Places>& places) {
  return {reinterpret_cast<const char*>(places.data()), places.size() * sizeof(Places)};
}

TEST_P(ClusterPairsScenes, HoldEveryPairOnce) {
  const Box box = GetParam().box;
  for (const std::size_t n : {0u, 1u, 2u, 3u, 4u, 5u, 17u, 100u, 350u})
    for (const scenes::NamedPoints& scene : scenes::hard_point_sets(box, n, kRadius / 2.1))
      for (const double base_radius : {0.0, 0.2 * kRadius, kRadius}) {
        ListedHierarchy hierarchy = hierarchy_of(scene.points, box, kRadius, base_radius);
        ClusterPairs pairs;
        hierarchy.cluster_pairs(within_skin(0.8, 0.2), pairs);
        ASSERT_EQ(cluster_pair_fault(pairs, scene.points, box, within_skin(0.8, 0.2)), "")
            << scene.name << ", n = " << n << ", R_0 = " << base_radius;
      }
}

TEST_P(ClusterPairsScenes, LeaveOutExclusionsGhostsAndTypesWithoutACutoff) {
  const Box box = GetParam().box;
  for (const scenes::NamedPoints& scene : scenes::hard_point_sets(box, 300, kRadius / 2.1)) {
    std::vector<std::int32_t> types(scene.points.size());
    for (std::size_t i = 0; i < types.size(); ++i) types[i] = static_cast<std::int32_t>(i % 3);
    std::vector<IndexPair> bonds;
    for (std::size_t i = 0; i + 1 < types.size(); ++i)
      bonds.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(i + 1)});
    const Exclusions exclusions = Exclusions::from_bonds(types.size(), bonds, 2);
    ListParams excluded = within(1), typed = within(1), ghosts = within(1);
    excluded.exclusions = &exclusions;
    typed.cutoffs = TypeCutoffs(3, {0.5, 0.0, 1.0, 0.0, 0.0, 0.7, 1.0, 0.7, 0.9});
    typed.types = types;
    ghosts.first_ghost = static_cast<std::int32_t>(types.size() / 3);
    ListParams all = typed;
    all.exclusions = &exclusions;
    all.first_ghost = ghosts.first_ghost;
    ListedHierarchy hierarchy = hierarchy_of(scene.points, box, kRadius);
    int kind = 0;
    for (const ListParams& request : {excluded, typed, ghosts, all}) {
      ClusterPairs pairs;
      hierarchy.cluster_pairs(request, pairs);
      ASSERT_EQ(cluster_pair_fault(pairs, scene.points, box, request), "") << scene.name << ", " << kind++;
      if (request.first_ghost >= 0)
        pairs.for_each([&](std::int32_t i, std::int32_t j, Vec3) {
          ASSERT_TRUE(i < request.first_ghost || j < request.first_ghost);
        });
      if (request.exclusions)
        pairs.for_each(
            [&](std::int32_t i, std::int32_t j, Vec3) { ASSERT_FALSE(i != j && exclusions.excluded(i, j)); });
    }
  }
}

// Two images of a node matter to another one in these.
TEST_P(ClusterPairsScenes, HoldEveryPairOnceInTheSmallestBox) {
  const Box box = GetParam().box;
  if (!box.any_periodic()) return;
  for (const double share : {1.0, 0.999, 0.9, 0.7})
    for (const double base_radius : {0.0, 0.3 * box.max_cutoff(), 3 * box.max_cutoff()})
      for (const scenes::NamedPoints& scene : scenes::hard_point_sets(box, 150, box.max_cutoff() / 2.1)) {
        const ListParams request = within(share * box.max_cutoff());
        ListedHierarchy hierarchy = hierarchy_of(scene.points, box, box.max_cutoff(), base_radius);
        ClusterPairs pairs;
        hierarchy.cluster_pairs(request, pairs);
        ASSERT_EQ(cluster_pair_fault(pairs, scene.points, box, request), "")
            << scene.name << ", share " << share << ", R_0 = " << base_radius;
      }
}

TEST_P(ClusterPairsScenes, AreTheSameOnEveryInstructionSetAndAnyNumberOfThreads) {
  const Box box = GetParam().box;
  const std::vector<Vec3> points = scenes::uniform_in(box, 3000, 14);
  const RestoreInstructionSet restore;
  ClusterPairs expected;
  for (const int threads : {1, 2, 3})
    for (const InstructionSet set : supported_sets()) {
      set_instruction_set(set);
      const auto pool = make_thread_pool(threads);
      ListedHierarchy hierarchy = hierarchy_of(points, box, 0.5, 0.6, pool.get());
      ClusterPairs pairs;
      for (int repeat = 0; repeat < 2; ++repeat) hierarchy.cluster_pairs(within(0.5), pairs);
      if (expected.rows.empty()) {
        expected = pairs;
        ASSERT_EQ(cluster_pair_fault(pairs, points, box, within(0.5)), "");
      }
      ASSERT_TRUE(same(pairs, expected)) << threads << " threads, " << name(set);
    }
}

// Within the skin no pair comes in or goes, whether atoms leave the cell, are wrapped back or jump cells.
TEST_P(ClusterPairsScenes, StayCompleteUnderMotionWithinTheSkin) {
  const Box box = GetParam().box;
  const double cutoff = 0.7, skin = 0.3;
  scenes::Random random(77);
  for (const scenes::NamedPoints& scene : scenes::hard_point_sets(box, 300, kRadius / 2.1)) {
    if (scene.name == "one far point") continue;  // its motion is below rounding
    ListedHierarchy hierarchy = hierarchy_of(scene.points, box, kRadius);
    ClusterPairs pairs;
    hierarchy.cluster_pairs(within_skin(cutoff, skin), pairs);
    std::vector<Vec3> moved = scene.points;
    std::vector<Vec3> displacement(moved.size());
    for (Vec3& d : displacement) d = random.in_ball(0.5 * skin);
    for (const double part : {0.3, 1.0, 0.2}) {
      for (std::size_t i = 0; i < moved.size(); ++i) {
        moved[i] = scene.points[i] + part * displacement[i];
        if (i % 3 == 0) moved[i] = box.wrap(moved[i]);
        for (int axis = 0; i % 3 == 1 && axis < 3; ++axis)
          if (box.periodic(axis))
            moved[i] = moved[i] + (static_cast<double>(random.below(5)) - 2) * box.vector(axis);
      }
      pairs.refresh(moved, box);
      ASSERT_EQ(cluster_pair_fault(pairs, moved, box, within(cutoff)), "") << scene.name << ", " << part;
    }
  }
}

TEST_P(ClusterPairsScenes, RefreshGivesWhatANewSearchGives) {
  const Box box = GetParam().box;
  std::vector<Vec3> points = scenes::uniform_in(box, 400, 5);
  ListedHierarchy hierarchy = hierarchy_of(points, box, kRadius);
  ClusterPairs pairs;
  hierarchy.cluster_pairs(within(kRadius), pairs);
  const auto before = pairs.at;
  pairs.refresh(points, box);
  for (std::size_t c = 0; c < before.size(); ++c)
    for (int slot = 0; slot < 4; ++slot) {
      ASSERT_EQ(before[c].x[slot], pairs.at[c].x[slot]);
      ASSERT_EQ(before[c].y[slot], pairs.at[c].y[slot]);
      ASSERT_EQ(before[c].z[slot], pairs.at[c].z[slot]);
      const double origin = pairs.origin[static_cast<std::size_t>(pairs.origin_of[c])].x;
      const double units = std::remainder((origin + pairs.at[c].x[slot]) / pairs.unit, 0x1p32);
      ASSERT_LT(pairs.unit, 1e-7);
      ASSERT_NEAR(std::remainder(static_cast<double>(pairs.at_in_units[c].x[slot]) - units, 0x1p32), 0, 1.01);
    }
}

// Repairs that were put off, points on their own that come near others: the structure in all its states.
TEST_P(ClusterPairsScenes, FollowTheStructureUnderMotion) {
  const Box box = GetParam().box;
  for (const double radius : {0.6, 0.2}) {
    scenes::Random random(8);
    std::vector<Vec3> points = scenes::uniform_in(box, 1200, 9);
    StructureParams params;
    params.radius = radius;
    ListedHierarchy hierarchy(params);
    hierarchy.build(points, box);
    ClusterPairs pairs;
    for (int step = 0; step < 12; ++step) {
      for (Vec3& p : points) p = p + random.in_cube((step < 8 ? 0.02 : 0.2) * radius);
      hierarchy.update(points, box);
      hierarchy.cluster_pairs(within(radius), pairs);
      ASSERT_EQ(cluster_pair_fault(pairs, points, box, within(radius)), "")
          << "step " << step << ", radius " << radius;
    }
    EXPECT_GT(hierarchy.stats().refreshes, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, ClusterPairsScenes, ::testing::ValuesIn(scenes::all_boxes(5.0)),
                         [](const auto& p) { return p.param.name; });

// A cell that shears and swells: shifts follow.
TEST(ClusterPairsTest, RefreshTakesAnotherShapeOfTheCell) {
  const Vec3 a{5, 0, 0}, b{1, 5, 0}, c{0.5, -1, 5};
  const Box box = Box::triclinic(a, b, c);
  const Box strained = Box::triclinic(1.01 * a, b + Vec3{0.05, 0.02, 0}, c + Vec3{0, 0.06, -0.03});
  std::vector<Vec3> points = scenes::uniform_in(box, 500, 3), moved;
  for (const Vec3 p : points)
    moved.push_back(strained.wrap(scenes::from_fractional(strained, box.fractional(p))));
  ListedHierarchy hierarchy = hierarchy_of(points, box, 1.2);
  ClusterPairs pairs;
  hierarchy.cluster_pairs(within(1.2), pairs);
  pairs.refresh(moved, strained);
  EXPECT_EQ(cluster_pair_fault(pairs, moved, strained, within(0.9)), "");
}

TEST(ClusterPairsTest, RefusesWhatDoesNotFit) {
  const Box box = Box::orthorhombic({5, 5, 5});
  std::vector<Vec3> points = scenes::uniform_in(box, 50, 3);
  ListedHierarchy hierarchy = hierarchy_of(points, box, 1);
  ClusterPairs pairs;
  EXPECT_THROW(hierarchy.cluster_pairs(within(1.1), pairs), InvalidParameter);
  EXPECT_THROW(hierarchy.cluster_pairs(within(1e-10), pairs), InvalidParameter);
  hierarchy.cluster_pairs(within(1), pairs);
  const double was = std::exchange(points[7].y, std::nan(""));
  EXPECT_THROW(pairs.refresh(points, box), InvalidPosition);
  points[7].y = was;
  pairs.refresh(points, box);
  EXPECT_EQ(cluster_pair_fault(pairs, points, box, within(1)), "") << "a refused position left something";
  points.pop_back();
  EXPECT_THROW(pairs.refresh(points, box), InvalidParameter);
  points.push_back({});
  EXPECT_THROW(pairs.refresh(points, Box::orthorhombic({5, 5, 5}, {true, true, false})), InvalidBox);
}

// Half of the clusters are split by a boundary, on any number of threads, and the first of those that are
// nowhere is named.
TEST(ClusterPairsTest, RefreshIsTheSameOnAnyNumberOfThreads) {
  const Box box = Box::orthorhombic({5, 5, 5});
  const std::vector<Vec3> points = scenes::uniform_in(box, 800, 4);
  ListedHierarchy hierarchy = hierarchy_of(points, box, 1);
  ClusterPairs found;
  hierarchy.cluster_pairs(within(1), found);
  ASSERT_GT(found.split_clusters.size(), 20u);
  scenes::Random random(3);
  std::vector<Vec3> moved = points, nowhere = points;
  for (Vec3& p : moved) p = box.wrap(p + random.in_cube(0.2));
  for (const std::size_t k : {2, 4, 9, 17}) {
    const auto split = found.split_clusters[k].cluster * ClusterPairs::kSlots;
    nowhere[static_cast<std::size_t>(found.particle[static_cast<std::size_t>(split)])].z = std::nan("");
  }
  const auto refreshed = [&](Executor* executor) {
    ClusterPairs pairs = found;
    const std::string message =
        test::message_of<InvalidPosition>([&] { pairs.refresh(nowhere, box, executor); });
    pairs.refresh(moved, box, executor);
    EXPECT_EQ(cluster_pair_fault(pairs, moved, box, within(0.5)), "");
    return std::tuple(message, pairs.unit, bits_of(pairs.at), bits_of(pairs.at_in_units),
                      bits_of(pairs.shift_in_units));
  };
  const auto alone = refreshed(nullptr);
  for (const int threads : {2, 3, 7}) {
    const auto pool = make_thread_pool(threads);
    EXPECT_EQ(refreshed(pool.get()), alone) << threads << " threads";
  }
}

}  // namespace
}  // namespace dch
