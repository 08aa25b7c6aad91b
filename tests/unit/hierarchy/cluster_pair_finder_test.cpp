// SPDX-License-Identifier: MIT
//
// The search of cluster pairs in scenes of a few nodes, to the last digit and the last thing looked at.
#include "clusters/cluster_pair_finder.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>

#include "hand_made_nodes.hpp"
#include "scenes.hpp"

namespace dch::detail {
namespace {

constexpr double kInflate = 1 + 1e-12;  // of distances of nodes, for rounding

TEST(ClusterPairFinder, LooksAtNodesUpToTheReachAndRoundingBeyond) {
  for (const double extent : {0.0, 0.5}) {
    const double limit = (1 + extent + extent) * kInflate;
    for (const double distance : {limit, std::nextafter(limit, 9)}) {
      HandMadeNodes scene;
      const std::vector<Vec3> around{{0, 0.3 * extent / 0.5, 0.4 * extent / 0.5}};
      scene.join(scene.add({}, around), scene.add({distance, 0, 0}, around));
      EXPECT_EQ(scene.work_of(1).beside_nodes, distance == limit ? 3 : 2) << extent;
    }
  }
}

// Both images half a period away hold points within the reach, which is that minus the extents.
TEST(ClusterPairFinder, LooksAtAllImagesWhereTwoOfANodeMayMatter) {
  const Box box = Box::orthorhombic({8, 32, 32});
  double least = 4 / kInflate - 2;
  while ((least + 2) * kInflate >= 4) least = std::nextafter(least, 0);
  while ((least + 2) * kInflate < 4) least = std::nextafter(least, 9);
  for (const double reach : {least, std::nextafter(std::nextafter(least, 0), 0), 2.0}) {
    HandMadeNodes scene(box);
    scene.join(scene.add({2, 0, 0}, {{-1, 0, 0}, {1, 0, 0}}), scene.add({6, 0, 0}, {{-1, 0, 0}, {1, 0, 0}}));
    scene.find(reach);
    EXPECT_EQ(scene.pairs.shift.size(), reach < least ? 2u : 4u) << 2 - reach;
  }
}

TEST(ClusterPairFinder, HasNoShiftsToNodesWithoutAClusterNearby) {
  HandMadeNodes scene;
  scene.join(scene.add({}, {{0, 1, 0}, {0, -1, 0}}), scene.add({2, 0, 0}, {{0, 1, 0}, {0, -1, 0}}));
  const ClusterPairFinder::Work work = scene.work_of(1);
  EXPECT_EQ(work.beside_nodes, 3);
  EXPECT_EQ(work.beside_clusters, 2);
  EXPECT_EQ(work.by_points, 2);
  EXPECT_EQ(scene.pairs.shift.size(), 2u);
}

// Four clusters in a row in each of two nodes: those whose boxes are apart are not compared point by point.
TEST(ClusterPairFinder, ComparesPointsOfClustersWithBoxesNearEachOtherAlone) {
  std::vector<Vec3> row;
  for (int k = 0; k < 16; ++k) row.push_back({1.0 * (k / 4) - 1.5, 0.01 * (k % 4), 0});
  HandMadeNodes scene;
  scene.add({-100, 0, 0}, row);
  scene.join(scene.add({}, row), scene.add({4, 0, 0}, row));
  for (int repeat = 0; repeat < 2; ++repeat) {
    const ClusterPairFinder::Work work = scene.work_of(1.25);
    EXPECT_EQ(work.beside_nodes, 3 * 4 + 4);
    EXPECT_EQ(work.beside_clusters, 3 * (4 + 3 + 2 + 1) + 4) << "the one of the other node that is near";
    EXPECT_EQ(work.by_points, 3 * (4 + 3) + 1);
    EXPECT_EQ(work.by_slots, 0);
    EXPECT_EQ(scene.pairs.entries.size(), 22u);
  }
  for (const int threads : {1, 2, 3}) {
    CountedParts executor(threads);
    scene.find(1.25, &executor);
    EXPECT_EQ(scene.finder.work().by_points, 22) << threads << " threads";
  }
}

// What forbids pairs is looked up where there is any such thing, and only for rows that it may be in.
TEST(ClusterPairFinder, LooksUpSlotsWhereTheyMatterAlone) {
  HandMadeNodes scene;
  scene.join(scene.add({}, {{}, {0.1, 0, 0}}), scene.add({0.5, 0, 0}, {{}, {0.1, 0, 0}}));
  EXPECT_EQ(scene.work_of(1).by_slots, 0);
  const std::vector<std::int32_t> types{0, 1, 1, 0};
  scene.request.types = types;
  scene.request.cutoffs = TypeCutoffs(2, {0.5, 1, 1, 0.5});
  EXPECT_EQ(scene.work_of(1).by_slots, 0) << "no pair of types is dropped";
  scene.request.cutoffs = TypeCutoffs(2, {0, 1, 1, 0});
  EXPECT_EQ(scene.work_of(1).by_slots, 3);
  scene.request.cutoffs = TypeCutoffs(1);
  EXPECT_EQ(scene.work_of(1).by_slots, 0);
  const Exclusions none, first_two = Exclusions::from_pairs(4, std::vector<IndexPair>{{0, 1}});
  scene.request.exclusions = &none;
  EXPECT_EQ(scene.work_of(1).by_slots, 0);
  scene.request.exclusions = &first_two;
  EXPECT_EQ(scene.work_of(1).by_slots, 3);
  scene.request.exclusions = nullptr;
  scene.request.first_ghost = 2;
  EXPECT_EQ(scene.work_of(1).by_slots, 1) << "of the second cluster with itself";
}

// Entries name shifts by 16 bits.
TEST(ClusterPairFinder, ClustersWithMoreShiftsThanARowCanNameHaveSeveral) {
  for (const std::int32_t others : {65535, 65536, 65537}) {
    HandMadeNodes scene;
    scene.add({9, 0, 0}, {{}, {0.1, 0, 0}});  // with a shift in front of those of the next node
    const std::int32_t middle = scene.add({}, {{}, {0, 0.01, 0}});
    scenes::Random random(1);
    for (std::int32_t k = 0; k < others; ++k) scene.join(middle, scene.add(random.in_ball(0.9)));
    const ClusterPairs& pairs = scene.find(1);
    std::vector<std::int64_t> lengths;
    for (std::size_t r = 0; r + 1 < pairs.rows.size(); ++r) {
      const ClusterPairs::Row& row = pairs.rows[r];
      lengths.push_back(pairs.rows[r + 1].first - row.first);
      for (std::int64_t e = row.first; e < pairs.rows[r + 1].first; ++e) {
        const ClusterPairs::Entry& entry = pairs.entries[static_cast<std::size_t>(e)];
        const auto& shift = pairs.shift[static_cast<std::size_t>(row.first_shift + entry.shift)];
        ASSERT_EQ(shift.from, pairs.origin_of[static_cast<std::size_t>(row.cluster)]);
        ASSERT_EQ(shift.to, pairs.origin_of[static_cast<std::size_t>(entry.cluster)]);
        ASSERT_EQ(entry.mask, entry.cluster == row.cluster ? 2 : 0x11);
      }
    }
    std::vector<std::int64_t> expected{1, 1 + std::min(others, 65535)};
    if (others > 65535) expected.push_back(others - 65535);
    EXPECT_EQ(lengths, expected);
    EXPECT_EQ(scene.finder.work().by_slots, 0);
  }
}

TEST(ClusterPairFinder, MasksMakeOneRowOfACluster) {
  HandMadeNodes scene;
  for (int k = 0; k < 6; ++k) scene.add({0.1 * k, 0, 0}, {{}, {0, 0.1, 0}, {0, 0, 0.1}});
  for (std::int32_t k = 1; k < 6; ++k) scene.join(0, k);
  scene.request.first_ghost = 1;
  const ClusterPairs& pairs = scene.find(1);
  ASSERT_EQ(pairs.rows.size(), 2u) << "and the end";
  EXPECT_EQ(pairs.entries.size(), 6u);
}

struct Found {
  std::size_t pairs;
  double margin;
};

/// Pairs of nodes with a point each, `distance` apart in all directions, the points up to `extent` from their
/// nodes: what is found of them with this reach.
Found found(double reach, double extent, double distance, std::uint64_t seed, int pairs) {
  scenes::Random random(seed);
  HandMadeNodes scene;
  const auto on_sphere = [&](double radius) {
    const Vec3 p = random.in_ball(1);
    return radius / std::sqrt(norm2(p)) * p;
  };
  for (int k = 0; k < pairs; ++k) {
    const Vec3 a = on_sphere(extent), b = on_sphere(extent), start = random.in_cube(1);
    // Along an axis now and then, where roundings add up.
    const Vec3 apart = k % 2 == 0 ? on_sphere(distance) : Vec3{0, k % 4 < 2 ? distance : -distance, 0};
    scene.join(scene.add(start, {a}), scene.add(start + (a + apart - b), {b}));
  }
  return {scene.find(reach).entries.size(), scene.finder.margin()};
}

// Coordinates and squares are rounded to integers: no pair is lost to that, and none is kept beyond the
// margin, which is a few units: fewer than six for points, and what 2.5 in the sum of squares are.
TEST(ClusterPairFinder, RoundingLosesNoPairAndKeepsNoneBeyondItsMargin) {
  constexpr int kPairs = 4000;
  scenes::Random random(5);
  for (const double extent : {1e-3, 0.5, 1.0, 3.0})
    for (int trial = 0; trial < 8; ++trial) {
      const double reach = random.uniform(1, trial % 2 == 0 ? 1.0001 : 2);
      const auto seed = static_cast<std::uint64_t>(trial);
      const auto [within, margin] = found(reach, extent, reach * (1 - 1e-12), seed, kPairs);
      EXPECT_EQ(within, kPairs) << reach << ", " << extent;
      EXPECT_EQ(found(reach, extent, reach + 1.01 * margin, seed, kPairs).pairs, 0u)
          << reach << ", " << extent;
      const double unit = (reach + 0.5 * extent) / 31768;
      EXPECT_LT(margin, 6 * unit + 4 * 0x1p14 * unit * unit / reach) << reach << ", " << extent;
    }
}

TEST(ClusterPairFinder, HasAWiderMarginFarOutWhereOriginsAreNoIntegers) {
  double margin[2];
  for (const int far : {0, 1}) {
    HandMadeNodes scene;
    scene.add({1e10 * far, 0, 0}, {{}, {0.5, 0, 0}});
    scene.find(1);
    margin[far] = scene.finder.margin();
  }
  EXPECT_GT(margin[1], margin[0]);
}

TEST(ClusterPairFinder, TakesSeveralPartsForEachOfSeveralThreads) {
  HandMadeNodes scene;
  for (int k = 0; k < 23; ++k) scene.add({9.0 * k, 0, 0}, {{}, {0.1, 0, 0}});
  CountedParts one(1), two(2);
  scene.find(1, &one);
  EXPECT_EQ(one.asked, std::vector<int>());
  ClusterPairs fresh;
  std::swap(scene.pairs, fresh);
  scene.find(1, &two);
  EXPECT_EQ(two.asked, (std::vector<int>{2, 16, 16})) << "to cut clusters, find pairs and join them";
  EXPECT_EQ(scene.pairs.entries.size(), 23u);
  EXPECT_EQ(scene.pairs.entries.capacity(), scene.pairs.entries.size()) << "no array grows twice";
  EXPECT_EQ(scene.pairs.rows.capacity(), scene.pairs.rows.size());
  EXPECT_EQ(scene.pairs.shift.capacity(), scene.pairs.shift.size());
}

TEST(ClusterPairFinder, PutsPaddingAndPositionsIntoSlots) {
  HandMadeNodes scene;
  scene.add({0.123456789, 9.87654321, 1 / 3.0}, {{0.5, 0.25, -0.125}, {-0.5, 0.125, 0.25}});
  const std::vector<std::int32_t> types{1, 2};
  scene.request.types = types;
  scene.request.cutoffs = TypeCutoffs(3, std::vector<double>(9, 1));
  const ClusterPairs& pairs = scene.find(1);
  ASSERT_EQ(pairs.particle.size(), 4u);
  for (int slot = 0; slot < 4; ++slot) {
    const auto s = static_cast<std::size_t>(slot);
    const std::int32_t i = pairs.particle[s];
    EXPECT_EQ(i < 0, slot >= 2);
    EXPECT_EQ(pairs.type[s], i < 0 ? 0 : types[static_cast<std::size_t>(i)]) << "0 for padding";
    const Vec3 at =
        scene.positions[static_cast<std::size_t>(pairs.particle[i < 0 ? 0 : s])] - scene.nodes.position[0];
    EXPECT_NEAR(pairs.at[0].x[slot], at.x, 1e-7);
    EXPECT_NEAR(pairs.at[0].y[slot], at.y, 1e-7);
    EXPECT_NEAR(pairs.at[0].z[slot], at.z, 1e-7);
  }
  // Origins have few digits.
  for (int axis = 0; axis < 3; ++axis) {
    const double multiples = std::ldexp(pairs.origin[0][axis], 13);
    EXPECT_EQ(multiples, std::nearbyint(multiples));
    EXPECT_NEAR(pairs.origin[0][axis], scene.nodes.position[0][axis], 1e-4);
  }
}

TEST(ClusterPairFinder, RefusesMoreThanIndicesName) {
  HandMadeNodes scene;
  for (int k = 0; k < 3; ++k) scene.add({9.0 * k, 0, 0}, {{}, {0.1, 0, 0}});
  CountedParts two(2);
  for (Executor* executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&two)}) {
    scene.finder.limits = {12, 3};
    EXPECT_EQ(scene.find(1, executor).entries.size(), 3u);
    scene.finder.limits = {11, 3};
    EXPECT_THROW(scene.find(1, executor), InvalidParameter);
    scene.finder.limits = {12, 2};
    EXPECT_THROW(scene.find(1, executor), InvalidParameter);
    scene.finder.limits = {12, 3};
    EXPECT_EQ(scene.find(1, executor).entries.size(), 3u) << "afterwards";
  }
}

TEST(ClusterPairFinder, ForgetsWhatIsOfTheLastSearchAlone) {
  HandMadeNodes scene;
  scene.add({}, {{}, {0.1, 0, 0}});
  scene.pairs.split_clusters.resize(1);
  scene.pairs.has_shift_vectors = true;
  const ClusterPairs& pairs = scene.find(1);
  EXPECT_TRUE(pairs.split_clusters.empty());
  EXPECT_FALSE(pairs.has_shift_vectors);
}

TEST(ClusterPairFinder, LooksAtNothingThatDeadNodesHaveLeft) {
  HandMadeNodes scene;
  scene.add({}, {{}, {0.1, 0, 0}});
  const std::int32_t dead = scene.add({1, 0, 0}, {{}, {0.1, 0, 0}});
  scene.nodes.retire(dead);
  EXPECT_EQ(scene.find(1).clusters(), 1);
  EXPECT_EQ(scene.finder.work().beside_nodes, 1);
}

}  // namespace
}  // namespace dch::detail
