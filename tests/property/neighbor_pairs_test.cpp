// SPDX-License-Identifier: MIT
//
// Pairs over all images, with their shifts, against brute force over images, in every kind of box, with
// cutoffs from a part of the cell to four times its height.
#include <algorithm>
#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tuple>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>
#include <dch/engines/neighbor_pairs.hpp>
#include <dch/lists/stale_test.hpp>

#include "effort.hpp"
#include "error_message.hpp"
#include "neighbor_pairs_oracle.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

using images::brute_force;
using images::displacement;
using images::Pair;
using images::Scene;
using Shift = NeighborPairs::Shift;

std::vector<Pair> unsorted_pairs_of(const NeighborPairs& found, const Scene& scene) {
  std::vector<Pair> pairs;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(found.particles()); ++i) {
    found.for_each_in_row(i, scene.points, [&](std::int32_t j, const Shift& s, Vec3 d) {
      EXPECT_EQ(d, displacement(scene.points[i], scene.points[j], scene.box, s)) << i << " " << j;
      pairs.push_back({i, j, s});
    });
  }
  return pairs;
}

std::vector<Pair> pairs_of(const NeighborPairs& found, const Scene& scene) {
  auto pairs = unsorted_pairs_of(found, scene);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Points of any kind, some of them many cells away, along open axes too.
std::vector<Vec3> some_points(const Box& box, std::size_t n, scenes::Random& random) {
  auto points = scenes::hard_point_sets(box, n, 0.3);
  std::vector<Vec3> chosen = points[random.below(points.size())].points;
  for (Vec3& p : chosen) {
    if (std::abs(p.x) > 1e9) p.x = 7.5;  // no image of that one has a number
    if (random.below(3) != 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const double cells = static_cast<double>(random.below(7)) - 3;
      if (box.periodic(axis)) p = p + cells * box.vector(axis);
    }
    if (!box.periodic(2)) p.z += random.uniform(-9, 9);
  }
  return chosen;
}

/// Cutoffs in heights of the cell; the number of particles keeps that of pairs about the same.
struct Reach {
  double heights;
  std::size_t particles;
};
constexpr Reach kReaches[] = {{0.2, 60}, {0.5, 40}, {0.51, 40}, {0.9, 24}, {1, 24}, {2, 8}, {4, 3}};

class NeighborPairsInBoxes : public testing::TestWithParam<scenes::NamedBox> {
 protected:
  double height() const { return GetParam().box.any_periodic() ? GetParam().box.min_height() : 3; }
};

TEST_P(NeighborPairsInBoxes, AreThoseOfAllImages) {
  scenes::Random random(41);
  for (const Reach& reach : kReaches) {
    for (int turn = 0; turn < effort(8); ++turn) {
      Scene scene{GetParam().box, some_points(GetParam().box, reach.particles, random), {}};
      const double cutoff = reach.heights * height() * (turn % 2 == 0 ? 1 : random.uniform(0.7, 1));
      scene.params.cutoffs = TypeCutoffs(cutoff);
      scene.params.kind = random.below(2) == 0 ? ListKind::full : ListKind::half;
      const NeighborPairs found = neighbor_pairs(scene.points, scene.box, scene.params);
      const auto expected = brute_force(scene, cutoff);
      ASSERT_EQ(found.listed(), static_cast<std::int64_t>(expected.size()));
      ASSERT_EQ(pairs_of(found, scene), expected) << reach.heights << " heights, turn " << turn;
    }
  }
}

TEST_P(NeighborPairsInBoxes, HaveTheCutoffsOfTypesAndRadii) {
  scenes::Random random(42);
  for (const Reach& reach : kReaches) {
    for (int turn = 0; turn < 2; ++turn) {
      Scene scene{GetParam().box, some_points(GetParam().box, reach.particles, random), {}};
      const double cutoff = reach.heights * height();
      std::vector<std::int32_t> types;
      std::vector<double> radii;
      for (std::size_t i = 0; i < scene.points.size(); ++i) {
        types.push_back(static_cast<std::int32_t>(random.below(3)));
        radii.push_back(i == 0 ? 0.5 * cutoff : random.uniform(0, 0.5 * cutoff));
      }
      if (turn == 0) {
        scene.params.cutoffs = TypeCutoffs(
            3, {cutoff, 0.3 * cutoff, 0, 0.3 * cutoff, 0, 0.6 * cutoff, 0, 0.6 * cutoff, 0.9 * cutoff});
        scene.params.types = types;
      } else {
        scene.params.radii = radii;
      }
      const NeighborPairs found = neighbor_pairs(scene.points, scene.box, scene.params);
      ASSERT_EQ(pairs_of(found, scene), brute_force(scene, cutoff)) << reach.heights << " heights";
    }
  }
}

TEST_P(NeighborPairsInBoxes, LeaveOutExcludedPairsInAllImages) {
  scenes::Random random(4177);
  for (const Reach& reach : kReaches) {
    Scene scene{GetParam().box, some_points(GetParam().box, reach.particles, random), {}};
    std::vector<IndexPair> excluded;
    for (std::size_t i = 1; i < scene.points.size(); i += 2)
      excluded.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(i) - 1});
    const Exclusions exclusions = Exclusions::from_pairs(scene.points.size(), excluded);
    const double cutoff = reach.heights * height();
    scene.params.cutoffs = TypeCutoffs(cutoff);
    for (const ListKind kind : {ListKind::full, ListKind::half}) {
      scene.params.kind = kind;
      std::vector<Pair> expected = brute_force(scene, cutoff);
      expected.erase(
          std::remove_if(expected.begin(), expected.end(),
                         [&](const Pair& p) { return exclusions.excluded(std::get<0>(p), std::get<1>(p)); }),
          expected.end());
      scene.params.exclusions = &exclusions;
      EXPECT_EQ(pairs_of(neighbor_pairs(scene.points, scene.box, scene.params), scene), expected);
      scene.params.exclusions = nullptr;
    }
  }
}

/// Particles move by up to half the skin and jump by whole cells, in a box that may change a little.
TEST_P(NeighborPairsInBoxes, FollowParticlesThatAreWrapped) {
  scenes::Random random(43);
  for (const Reach& reach : kReaches) {
    Scene scene{GetParam().box, some_points(GetParam().box, reach.particles, random), {}};
    const double cutoff = 0.85 * reach.heights * height(), skin = 0.15 * reach.heights * height();
    scene.params.cutoffs = TypeCutoffs(cutoff);
    scene.params.skin = skin;
    NeighborPairs found = neighbor_pairs(scene.points, scene.box, scene.params);
    for (int turn = 0; turn < 3; ++turn) {
      Scene now = scene;
      for (Vec3& p : now.points) {
        p = p + random.in_ball(0.49 * skin);
        for (int axis = 0; axis < 3; ++axis)
          if (now.box.periodic(axis))
            p = p + (static_cast<double>(random.below(3)) - 1) * now.box.vector(axis);
      }
      found.follow(now.points, now.box);
      ASSERT_EQ(pairs_of(found, now), brute_force(now, cutoff)) << reach.heights << " heights";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, NeighborPairsInBoxes, testing::ValuesIn(scenes::all_boxes(4)),
                         [](const auto& box) { return box.param.name; });

TEST(NeighborPairs, FollowABoxThatChangesAsTheStaleTestAllows) {
  const Box before = Box::triclinic({9, 0, 0}, {2, 8, 0}, {-1, 3, 10});
  const Box now = Box::triclinic({9.01, 0, 0}, {2, 7.99, 0}, {-1, 3.01, 10});
  Scene scene{before, scenes::uniform_in(before, 300, 5), {}};
  scene.params.cutoffs = TypeCutoffs(2.5);
  scene.params.skin = 0.4;
  NeighborPairs found = neighbor_pairs(scene.points, before, scene.params);
  StaleTest stale(scene.params.skin);
  stale.remember(scene.points, before);
  scene.box = now;
  scenes::Random random(6);
  for (Vec3& p : scene.points)
    p = p + random.in_ball(0.1) + static_cast<double>(random.below(2)) * now.vector(1);
  ASSERT_FALSE(stale.is_stale(scene.points, now));
  found.follow(scene.points, now);
  EXPECT_EQ(pairs_of(found, scene), brute_force(scene, 2.5));
}

TEST(NeighborPairs, FollowABoxThatTakesParticlesAlong) {
  const Box before = Box::triclinic({9, 0, 0}, {2, 8, 0}, {-1, 3, 10});
  const double grown = 1.05;
  const Box now =
      Box::triclinic(grown * before.vector(0), grown * before.vector(1), grown * before.vector(2));
  Scene scene{before, scenes::uniform_in(before, 300, 15), {}};
  scene.params.cutoffs = TypeCutoffs(2.5);
  scene.params.skin = 0.4;
  NeighborPairs found = neighbor_pairs(scene.points, before, scene.params);
  StaleTest stale(scene.params.skin);
  stale.remember(scene.points, before, 2.9);
  scene.box = now;
  scenes::Random random(16);
  for (Vec3& p : scene.points)
    p = grown * p + random.in_ball(0.15) + static_cast<double>(random.below(2)) * now.vector(1);
  ASSERT_FALSE(stale.is_stale(scene.points, now));
  found.follow(scene.points, now);
  EXPECT_EQ(pairs_of(found, scene), brute_force(scene, 2.5));
}

/// In the same order too.
TEST(NeighborPairs, AreTheSameOnAnyNumberOfThreads) {
  const Box box = Box::orthorhombic({6, 5, 7});
  Scene scene{box, scenes::uniform_in(box, 400, 7), {}};
  const auto threads = make_thread_pool(3);
  for (const double cutoff : {1.5, 4.0}) {
    scene.params.cutoffs = TypeCutoffs(cutoff);
    std::array<std::vector<Pair>, 2> pairs;
    for (std::size_t k = 0; k < 2; ++k) {
      scene.params.executor = k == 0 ? nullptr : threads.get();
      pairs[k] = unsorted_pairs_of(neighbor_pairs(scene.points, box, scene.params), scene);
    }
    ASSERT_EQ(pairs[0], pairs[1]);
  }
}

TEST(NeighborPairs, OfNoneAndOfOneParticle) {
  EXPECT_EQ(neighbor_pairs({}, Box::orthorhombic({1, 1, 1}), 1e6).listed(), 0);
  const std::vector<Vec3> one{{0.3, 70, -2}};
  EXPECT_EQ(neighbor_pairs(one, Box::none(), 5).listed(), 0);
  EXPECT_EQ(neighbor_pairs(one, Box::orthorhombic({1, 1, 1}), 1).listed(), 6);
}

TEST(NeighborPairs, RefuseWhatCannotBe) {
  const Box box = Box::orthorhombic({1, 1, 1});
  const std::vector<Vec3> points{{0, 0, 0}, {0.5, 0.5, 0.5}};
  NeighborPairsParams params;
  const auto find = [&] { return neighbor_pairs(points, box, params); };
  params.skin = -1;
  EXPECT_THROW(find(), InvalidParameter);
  params.skin = 0;
  params.cutoffs = TypeCutoffs(1e3);  // 1.6e10 images
  EXPECT_THAT(test::message_of<InvalidParameter>(find), testing::HasSubstr("smaller cutoff"));
  params.max_pairs = 1000000;
  EXPECT_THAT(test::message_of<TooManyPairs>(find), testing::HasSubstr("images of particles"));
  params.cutoffs = TypeCutoffs(1e31);
  EXPECT_THROW(find(), Error);
  const std::vector<std::int32_t> types{0};
  params.cutoffs = TypeCutoffs(0.3);
  params.types = types;
  EXPECT_THROW(find(), InvalidParameter);
  const std::vector<Vec3> far{{0, 0, 0}, {1e12, 0, 0}};
  EXPECT_THAT(test::message_of<InvalidPosition>([&] { neighbor_pairs(far, box, 0.3); }),
              testing::HasSubstr("wrap the coordinates"));
}

/// As far apart as the cutoff, on both sides.
TEST(NeighborPairs, OfBothImagesAtHalfAPeriod) {
  const Scene scene{Box::orthorhombic({2, 3, 4}), {{0.25, 0, 0}, {1.25, 0, 0}}, {}};
  EXPECT_THAT(pairs_of(neighbor_pairs(scene.points, scene.box, 1), scene),
              testing::ElementsAre(Pair{0, 1, {-1, 0, 0}}, Pair{0, 1, {0, 0, 0}}, Pair{1, 0, {0, 0, 0}},
                                   Pair{1, 0, {1, 0, 0}}));
}

/// Before memory is taken: 200,000 particles on one spot have 4e10 pairs.
TEST(NeighborPairs, RefuseMorePairsThanAsked) {
  const std::vector<Vec3> points(200000, Vec3{1, 2, 3});
  NeighborPairsParams params;
  params.max_pairs = 1000;
  EXPECT_THAT(
      test::message_of<TooManyPairs>([&] { neighbor_pairs(points, Box::none(), params); }),
      testing::AllOf(testing::HasSubstr("39999800000 pairs"), testing::HasSubstr("1000 are possible")));
}

/// A crystal, where all have as many neighbors.
TEST(NeighborPairs, AreAboutAsManyAsExpected) {
  const Box box = Box::orthorhombic({4, 4, 4});
  const auto points = scenes::fcc(box, std::sqrt(2.0));
  NeighborPairsParams params;
  for (const double cutoff : {1.5, 3.5}) {
    params.cutoffs = TypeCutoffs(cutoff);
    for (const ListKind kind : {ListKind::half, ListKind::full}) {
      params.kind = kind;
      EXPECT_EQ(expected_pairs(points, box, params),
                static_cast<double>(neighbor_pairs(points, box, params).listed()));
    }
  }
  EXPECT_EQ(expected_pairs({}, box, params), 0);
}

TEST(NeighborPairs, FollowOnlyTheSameParticles) {
  const Box box = Box::orthorhombic({5, 5, 5});
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}}, more{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  NeighborPairsParams params;
  params.skin = 0.5;
  NeighborPairs found = neighbor_pairs(points, box, params);
  EXPECT_THROW(found.follow(more, box), InvalidParameter);
  EXPECT_THROW(found.follow(points, Box::none()), InvalidParameter);
  const std::vector<Vec3> nowhere{{0, 0, 0}, {std::nan(""), 0, 0}};
  EXPECT_THROW(found.follow(nowhere, box), InvalidPosition);
}

}  // namespace
}  // namespace dch
