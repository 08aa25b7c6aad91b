// SPDX-License-Identifier: MIT
//
// A closest pair that is kept up, in scenes in which everything is random, against all pairs: after motion of
// all points and of some, while a repair is put off, after insertions and removals. And counts: the work
// grows with what changes.
//
// More than 300 lines: all tests take the same oracle and scenes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/kept_closest_pair.hpp>
#include <dch/proximity/point_tree.hpp>

#include "closest_bounds.hpp"
#include "effort.hpp"
#include "error_message.hpp"
#include "places.hpp"
#include "proximity_checks.hpp"
#include "proximity_scene.hpp"
#include "scenes.hpp"
#include "special_numbers.hpp"

namespace dch {
namespace {

using Answer = std::tuple<double, std::int32_t, std::int32_t>;

Answer of_all_pairs(const HierarchyView& view) {
  Answer least{kInfinity, -1, -1};
  const auto ids = static_cast<std::int32_t>(view.capacity());
  for (std::int32_t a = 0; a < ids; ++a)
    for (std::int32_t b = a + 1; b < ids; ++b)
      if (view.contains(a) && view.contains(b))
        least = std::min(least, {view.box().distance2(view.position(a), view.position(b)), a, b});
  return least;
}

Answer of(const ClosestPoints& found) { return {found.distance2, found.a, found.b}; }

TEST(KeptClosestPairs, EqualAllPairsInRandomScenes) {
  for (int k = 0; k < effort(400); ++k) {
    ProximityScene scene(7200000 + static_cast<std::uint64_t>(k), 120);
    KeptClosestPair kept, told;
    Places places;
    for (int step = 0; step < 12; ++step) {
      const HierarchyView view = scene.view();
      const Answer expected = of_all_pairs(view);
      ASSERT_EQ(of(kept.find(view)), expected) << scene.what() << ", step " << step;
      ASSERT_EQ(of(told.find(view, places.changed(view))), expected) << scene.what() << ", step " << step;
      scene.change(step / 2);
    }
  }
}

/// As in a simulation: many short steps of all points, of which few have to ask.
TEST(KeptClosestPairs, EqualAllPairsInRandomScenesOfShortSteps) {
  for (int k = 0; k < effort(150); ++k) {
    ProximityScene scene(7300000 + static_cast<std::uint64_t>(k), 120);
    KeptClosestPair kept;
    const double motion = scene.radius() * std::pow(10, scene.random.uniform(-4, -1));
    for (int step = 0; step < 25; ++step) {
      const HierarchyView view = scene.view();
      ASSERT_EQ(of(kept.find(view)), of_all_pairs(view)) << scene.what() << ", step " << step;
      if (step % 5 == 4) scene.exchange();
      scene.move(motion);
    }
  }
}

/// Points on the sites of a lattice, all of which are as close, and a few spots with many points each.
TEST(KeptClosestPairs, HaveTheSmallestIdsOfMany) {
  scenes::Random random(73);
  for (int k = 0; k < effort(60); ++k) {
    const Box box = k % 2 == 0 ? Box::none() : Box::orthorhombic({6, 6, 6});
    const double sites = k % 3 == 0 ? 2 : 6;
    const auto site = [&] {
      return Vec3{std::floor(random.uniform(0, sites)), std::floor(random.uniform(0, sites)),
                  std::floor(random.uniform(0, sites))};
    };
    std::vector<Vec3> points;
    for (int p = 0; p < 60; ++p) points.push_back(site());
    HierarchyParams params;
    params.radius = 1;
    Hierarchy hierarchy(params);
    hierarchy.build(points, box);
    KeptClosestPair kept;
    for (int step = 0; step < 40; ++step) {
      const HierarchyView view = hierarchy.kept_view();
      ASSERT_EQ(of(kept.find(view)), of_all_pairs(view)) << "scene " << k << ", step " << step;
      const auto id = static_cast<std::int32_t>(random.below(hierarchy.capacity()));
      if (hierarchy.contains(id)) hierarchy.remove(id);
      if (random.below(3) > 0) hierarchy.insert(site());
    }
  }
}

TEST(KeptClosestPairs, OfFewerThanTwoPointsThereAreNone) {
  HierarchyParams params;
  params.radius = 1;
  Hierarchy hierarchy(params);
  KeptClosestPair kept;
  hierarchy.build({}, Box::none());
  EXPECT_EQ(of(kept.find(hierarchy.view())), Answer(kInfinity, -1, -1));
  const std::int32_t id = hierarchy.insert({1, 1, 1});
  EXPECT_EQ(of(kept.find(hierarchy.view())), Answer(kInfinity, -1, -1));
  hierarchy.insert({1, 1, 3});
  EXPECT_EQ(of(kept.find(hierarchy.view())), Answer(4, 0, 1));
  hierarchy.remove(id);
  EXPECT_EQ(of(kept.find(hierarchy.view())), Answer(kInfinity, -1, -1));
}

TEST(KeptClosestPairs, RefuseIdsThatCannotBe) {
  HierarchyParams params;
  params.radius = 1;
  Hierarchy hierarchy(params);
  hierarchy.build(scenes::coincident(Box::none(), 3), Box::none());
  KeptClosestPair kept;
  kept.find(hierarchy.view());
  for (const std::int32_t id : {-1, 3}) {
    const std::vector<std::int32_t> changed{id};
    const std::string message =
        test::message_of<InvalidParameter>([&] { kept.find(hierarchy.view(), changed); });
    EXPECT_NE(message.find("point " + std::to_string(id)), std::string::npos) << message;
  }
  EXPECT_EQ(of(kept.find(hierarchy.view())), Answer(0, 0, 1));
}

struct Uniform {
  explicit Uniform(std::size_t points)
      : side(std::cbrt(static_cast<double>(points))), box(Box::orthorhombic({side, side, side})) {
    for (std::size_t k = 0; k < points; ++k) positions.push_back(somewhere());
    HierarchyParams params;
    params.radius = 1.5;
    hierarchy.emplace(params);
    hierarchy->build(positions, box);
  }
  Vec3 somewhere() { return {random.uniform(0, side), random.uniform(0, side), random.uniform(0, side)}; }
  /// Of a hundred, on a line.
  Vec3 in_cluster() {
    return Vec3{static_cast<double>(random.below(100)) * side / 100, 5, 5} + random.in_cube(0.002);
  }

  scenes::Random random{74};
  double side;
  Box box;
  std::vector<Vec3> positions;
  std::optional<Hierarchy> hierarchy;
};

/// Counts of one step in which ten points go and ten come, in the mean.
KeptClosestWork work_of_a_step(std::size_t points) {
  constexpr int kSteps = 50, kChanged = 10;
  Uniform scene(points);
  KeptClosestPair kept;
  kept.find(scene.hierarchy->kept_view());
  const KeptClosestWork before = kept.work();
  for (int step = 0; step < kSteps; ++step) {
    std::vector<std::int32_t> changed;
    for (int k = 0; k < kChanged; ++k) {
      const auto id = static_cast<std::int32_t>(scene.random.below(points));
      scene.hierarchy->remove(id);
      changed.push_back(scene.hierarchy->insert(scene.somewhere()));
      EXPECT_EQ(changed.back(), id);
    }
    kept.find(scene.hierarchy->kept_view(), changed);
  }
  KeptClosestWork work = kept.work();
  EXPECT_EQ(work.searches, before.searches);
  work.compared = (work.compared - before.compared) / kSteps;
  work.asked = (work.asked - before.asked) / kSteps;
  work.nearest.nodes = (work.nearest.nodes - before.nearest.nodes) / kSteps;
  work.nearest.blocks = (work.nearest.blocks - before.nearest.blocks) / kSteps;
  work.nearest.points = (work.nearest.points - before.nearest.points) / kSteps;
  return work;
}

TEST(KeptClosestPairs, LookAtWhatHasChangedAlone) {
  for (const std::size_t points : {10000, 40000, effort(160000)}) {
    const KeptClosestWork work = work_of_a_step(points);
    std::printf("%zu points: %lld asked, %lld nodes, %lld blocks, %lld points\n", points,
                static_cast<long long>(work.asked), static_cast<long long>(work.nearest.nodes),
                static_cast<long long>(work.nearest.blocks), static_cast<long long>(work.nearest.points));
    EXPECT_EQ(work.compared, 10);
    EXPECT_LE(work.asked, 12);
    EXPECT_LE(work.nearest.nodes, 2500);
    EXPECT_LE(work.nearest.blocks, 1000);
    EXPECT_LE(work.nearest.points, 300);
  }
}

/// After so many changes a grid answers, without nodes and blocks, wherever the points that change go.
TEST(KeptClosestPairs, ManyThatChangeLookAtFewOthers) {
  Uniform scene(20000);
  KeptClosestPair kept;
  kept.find(scene.hierarchy->kept_view());
  NearestWork before;
  for (int step = 0; step < 60; ++step) {
    std::vector<std::int32_t> changed;
    for (int k = 0; k < 200; ++k) {
      changed.push_back(static_cast<std::int32_t>(scene.random.below(20000)));
      scene.hierarchy->remove(changed.back());
      scene.hierarchy->insert(scene.somewhere());
    }
    const ClosestPoints found = kept.find(scene.hierarchy->kept_view(), changed);
    if (step % 20 == 19) {
      EXPECT_EQ(of(found), of(closest_pair(PointTree(scene.hierarchy->view()))));
    }
    if (step == 9) before = kept.work().nearest;
  }
  EXPECT_LE(kept.work().nearest.nodes - before.nodes, 10000 * 20);
  EXPECT_LE(kept.work().nearest.points - before.points, 10000 * 20);
}

/// A grid of the box and of places before would look in its old cells.
TEST(KeptClosestPairs, LookAtNoCellsOfAnotherBox) {
  constexpr std::size_t kPoints = 4000;
  Uniform scene(kPoints);
  KeptClosestPair kept;
  const auto exchange = [&](const Vec3& to) {
    const auto id = static_cast<std::int32_t>(scene.random.below(kPoints));
    scene.hierarchy->remove(id);
    EXPECT_EQ(scene.hierarchy->insert(to), id);
    return id;
  };
  const auto check = [&](Span<const std::int32_t> changed) {
    const ClosestPoints found = kept.find(scene.hierarchy->kept_view(), changed);
    EXPECT_EQ(of(found), of(closest_pair(PointTree(scene.hierarchy->view()))));
  };
  const auto steps = [&](int count, auto place) {
    for (int step = 0; step < count; ++step) {
      std::vector<std::int32_t> changed;
      for (int k = 0; k < 100; ++k) changed.push_back(exchange(place(k)));
      check(changed);
    }
  };
  steps(20, [&](int) { return scene.somewhere(); });
  scene.side *= 0.9;
  for (Vec3& position : scene.positions) position = scene.somewhere();
  scene.hierarchy->update(scene.positions, Box::orthorhombic({scene.side, scene.side, scene.side}));
  check({});
  steps(5, [&](int k) {  // beside a point that has stayed, ever nearer
    return scene.hierarchy->view().position((k * 37 + 11) % 4000) + scene.random.in_cube(1e-3 / (1 + k));
  });
}

/// Half of the points in clusters, whose cells have too many where cells suit the density of the others: the
/// next grid has cells that suit the distance asked for. All points that come and go are of clusters.
TEST(KeptClosestPairs, OfPointsInClustersLookAtFewOthers) {
  Uniform scene(10000);
  for (int k = 0; k < 10000; ++k) scene.positions.push_back(scene.in_cluster());
  scene.hierarchy->build(scene.positions, scene.box);
  KeptClosestPair kept;
  kept.find(scene.hierarchy->kept_view());
  KeptClosestWork before;
  for (int step = 0; step < 60; ++step) {
    std::vector<std::int32_t> changed;
    for (int k = 0; k < 100; ++k) {
      changed.push_back(10000 + static_cast<std::int32_t>(scene.random.below(10000)));
      scene.hierarchy->remove(changed.back());
      scene.hierarchy->insert(scene.in_cluster());
    }
    const ClosestPoints found = kept.find(scene.hierarchy->kept_view(), changed);
    if (step % 20 == 19) {
      EXPECT_EQ(of(found), of(closest_pair(PointTree(scene.hierarchy->view()))));
    }
    if (step == 19) before = kept.work();
  }
  EXPECT_LE(kept.work().nearest.nodes - before.nearest.nodes, 4000 * 20);
}

/// All on one spot: each is as close to each. The points of a few are compared, not those of all.
TEST(KeptClosestPairs, OfPointsThatCoincideAskFew) {
  HierarchyParams params;
  params.radius = 1;
  Hierarchy hierarchy(params);
  hierarchy.build(scenes::coincident(Box::none(), 3000), Box::none());
  KeptClosestPair kept;
  for (std::int32_t step = 0; step < 20; ++step) {
    EXPECT_EQ(of(kept.find(hierarchy.kept_view())), Answer(0, step, step + 1));
    hierarchy.remove(step);
  }
  EXPECT_LE(kept.work().asked, 20 * 30);
}

/// Whatever ids are named: of new ids, of fewer, and of another box.
TEST(KeptClosestPairs, TakeAllPointsOfNewIdsOrAnotherBox) {
  const std::vector<std::int32_t> none;
  std::vector<Vec3> points{{0.1, 1, 1}, {9.5, 1, 1}, {5, 5, 5}, {5.8, 5, 5}, {5, 8, 8}};
  const Box box = Box::orthorhombic({10, 10, 10});
  HierarchyParams params;
  params.radius = 1;
  Hierarchy hierarchy(params);
  hierarchy.build(points, box);
  KeptClosestPair kept;
  const auto check = [&](std::int32_t a, std::int32_t b) {
    const HierarchyView view = hierarchy.kept_view();
    const ClosestPoints found = kept.find(view, none);
    EXPECT_EQ(of(found), of_all_pairs(view));
    EXPECT_EQ(found.a, a);
    EXPECT_EQ(found.b, b);
  };
  check(0, 1);
  hierarchy.insert({5.5, 8, 8});
  check(4, 5);
  hierarchy.build(points, box);
  check(0, 1);
  points[0] = {5, 5, 5.3};  // not named, but asked for in another box
  hierarchy.update(points, Box::orthorhombic({10, 10, 9.8}));
  check(0, 2);
}

/// After motion that is so much farther than the closest pair is apart that rounding takes more of a bound
/// than that.
TEST(KeptClosestPairs, AskOnceHoweverMuchNearerThanTheMotionTheyAre) {
  std::vector<Vec3> points{{0, 0, 0}, {1e-15, 0, 0}, {50, 0, 0}, {60, 0, 0}};
  HierarchyParams params;
  params.radius = 1;
  Hierarchy hierarchy(params);
  hierarchy.build(points, Box::none());
  KeptClosestPair kept;
  kept.find(hierarchy.kept_view());
  for (Vec3& p : points) p.y += 100;
  hierarchy.update(points, Box::none());
  EXPECT_EQ(of(kept.find(hierarchy.kept_view())), of_all_pairs(hierarchy.kept_view()));
  const std::vector<std::int32_t> changed{hierarchy.insert({-70, 0, 0})};
  EXPECT_EQ(of(kept.find(hierarchy.kept_view(), changed)), of_all_pairs(hierarchy.kept_view()));
  EXPECT_LE(kept.work().asked, 10);
}

/// A point that was so many boxes away that its distances were rounded by 1e-7 comes back into the box: it is
/// where it was, and nearer to another one than it seemed to be.
TEST(KeptClosestPairs, AllowForRoundingOfPlacesFarAway) {
  constexpr double kSide = 10, kFarAway = kSide * (1 << 27), kHidden = 1.1e-7;
  const Box box = Box::orthorhombic({kSide, kSide, kSide});
  std::vector<Vec3> points{{1 + kHidden, 1, 1}, {2 + kFarAway, 1, 1}, {1, 6, 6}, {2 - kHidden / 2, 6, 6}};
  HierarchyParams params;
  params.radius = 1;
  Hierarchy hierarchy(params);
  hierarchy.build(points, box);
  KeptClosestPair kept;
  EXPECT_EQ(of(kept.find(hierarchy.kept_view())), of_all_pairs(hierarchy.kept_view()));
  points[1].x = 2;
  hierarchy.update(points, box);
  const Answer expected = of_all_pairs(hierarchy.kept_view());
  ASSERT_EQ(std::get<1>(expected), 0);
  EXPECT_EQ(of(kept.find(hierarchy.kept_view())), expected);
}

/// Many steps, each of which rounds the sum of all downwards.
TEST(KeptClosestPairs, AllowForRoundingOfManySteps) {
  constexpr double kBefore = 1e6, kStep = 1 + 0x1.8p-35, kDistance = 3000;
  detail::ClosestBounds bounds;
  bounds.grow(2);
  bounds.shrink_all(kBefore);
  bounds.set_none_within(0, kDistance);
  for (int k = 1; k <= 2000; ++k) bounds.shrink_all(kStep);
  EXPECT_EQ(bounds.next_below(kDistance - 2000 * kStep), 0);
  EXPECT_EQ(bounds.next_below((kDistance - 2000 * kStep) * 0.999), -1);
}

/// Of the sum of a bound and all motion before.
TEST(KeptClosestPairs, AllowForRoundingOfOneSum) {
  detail::ClosestBounds bounds;
  bounds.grow(2);
  bounds.shrink_all(1e6);
  for (int k = 0; k < 100; ++k) {
    const double distance = 1 + 1e-11 * k;
    bounds.set_none_within(0, distance);
    EXPECT_EQ(bounds.next_below(distance), 0);
    EXPECT_EQ(bounds.next_below(0.999 * distance), -1);
  }
}

/// Steps of a thousandth of the mean distance of neighbors.
TEST(KeptClosestPairs, AskFewOfThePointsThatAllMoveALittle) {
  Uniform scene(20000);
  KeptClosestPair kept;
  kept.find(scene.hierarchy->view());
  for (int step = 0; step < 20; ++step) {
    for (Vec3& p : scene.positions) p = p + scene.random.in_cube(0.001);
    scene.hierarchy->update(scene.positions, scene.box);
    kept.find(scene.hierarchy->view());
  }
  EXPECT_EQ(kept.work().searches, 1);
  EXPECT_LE(kept.work().asked, 20 * 20000 / 50);
}

}  // namespace

void check_kept_closest_pair(ProximityScene& scene, KeptClosestPair& kept) {
  const HierarchyView view = scene.view();
  ASSERT_EQ(of(kept.find(view)), of_all_pairs(view)) << scene.what();
}

}  // namespace dch
