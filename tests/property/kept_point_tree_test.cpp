// SPDX-License-Identifier: MIT
//
// Trees of points that are kept up while points move, come and go, in scenes in which everything is random:
// each of their promises and each query that takes one, against all points.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/point_tree.hpp>

#include "effort.hpp"
#include "error_message.hpp"
#include "liquid.hpp"
#include "moving_points.hpp"
#include "places.hpp"
#include "point_tree_checks.hpp"
#include "proximity_checks.hpp"
#include "proximity_scene.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

int depth_of(const PointTree& tree) {
  int depth = 0;
  for (std::int32_t at : nodes_from_the_root(tree)) {
    int levels = 0;
    for (; at >= 0; at = tree.node(at).parent) ++levels;
    depth = std::max(depth, levels);
  }
  return depth;
}

TEST(KeptPointTrees, HoldAllPointsInRandomScenes) {
  int pending = 0;
  std::int64_t kept_up = 0, built = 0;
  for (int k = 0; k < effort(300); ++k) {
    ProximityScene scene(7500000 + static_cast<std::uint64_t>(k), 400);
    PointTree tree(scene.view()), told(scene.view());
    Places places;
    places.changed(scene.view());
    for (int step = 0; step < 12; ++step) {
      if (step % 3 == 0) {
        scene.move(scene.radius() * std::pow(10, scene.random.uniform(-5, -0.5)));
      } else {
        scene.exchange();
      }
      const HierarchyView view = scene.view();
      pending += view.repair_pending();
      tree.update(view);
      told.update(view, places.changed(view));
      const std::string what = scene.what() + ", step " + std::to_string(step);
      ASSERT_NO_FATAL_FAILURE(check_kept_tree(tree, scene.ids(), what));
      ASSERT_NO_FATAL_FAILURE(check_kept_tree(told, scene.ids(), what + ", told"));
    }
    built += tree.work().builds - 1;
    kept_up += 12 - (tree.work().builds - 1);
  }
  EXPECT_GT(pending, effort(100));
  EXPECT_GT(built, effort(100));
  EXPECT_GT(kept_up, effort(1500));
}

TEST(KeptPointTrees, AnswerAsAllPairsDoInRandomScenes) {
  for (int k = 0; k < effort(150); ++k) {
    ProximityScene scene(7600000 + static_cast<std::uint64_t>(k), k % 3 == 0 ? 12 : 150);
    PointTree tree(scene.view());
    for (int step = 0; step < 8; ++step) {
      if (step % 4 == 0) scene.move(scene.radius() * std::pow(10, scene.random.uniform(-4, -1)));
      for (int change = 0; change < 4; ++change) scene.exchange_one();
      tree.update(scene.view());
      if (step % 2 == 0) continue;
      ASSERT_NO_FATAL_FAILURE(check_well_separated_pairs(scene, tree)) << "step " << step;
      ASSERT_NO_FATAL_FAILURE(check_spanner(scene, tree)) << "step " << step;
      ASSERT_NO_FATAL_FAILURE(check_centers(scene, tree)) << "step " << step;
      ASSERT_NO_FATAL_FAILURE(check_closest_pair(scene, tree)) << "step " << step;
    }
  }
}

/// Wide enough that a tree is kept up for long; every third step changes few points, moves all a little, or
/// has a few jump.
TEST(KeptPointTrees, HoldAllPointsOfLargerScenesForLong) {
  int number = 0;
  for (const scenes::NamedBox& named : scenes::all_boxes(10)) {
    MovingPoints scene(1500, named.box, 70 + static_cast<std::uint64_t>(number++));
    PointTree tree(scene.hierarchy->view());
    for (int step = 0; step < effort(40); ++step) {
      std::vector<std::int32_t> changed;
      if (step % 3 == 0) {
        changed = scene.exchange(1 + scene.random.below(60));
        tree.update(scene.hierarchy->kept_view(), changed);
      } else if (step % 3 == 1) {
        scene.shake(std::pow(10, scene.random.uniform(-4, -1.5)));
        tree.update(scene.hierarchy->view());
      } else {
        for (std::size_t jumps = scene.random.below(40); jumps > 0; --jumps)
          scene.positions[scene.random.below(scene.positions.size())] = scene.somewhere();
        scene.shake(0);
        tree.update(scene.hierarchy->view());
      }
      const std::string what = named.name + ", step " + std::to_string(step);
      ASSERT_NO_FATAL_FAILURE(check_kept_tree(tree, ids_of(scene.hierarchy->view()), what));
    }
    EXPECT_LE(tree.work().builds, 3) << named.name;
  }
}

/// Spots of many points each, some of which come and go, and points at all distances of one.
TEST(KeptPointTrees, HoldPointsThatCoincideOrNearlyDo) {
  scenes::Random random(75);
  for (int k = 0; k < effort(40); ++k) {
    const Box box = k % 2 == 0 ? Box::none() : Box::orthorhombic({8, 8, 8});
    const auto place = [&] {
      const Vec3 spot{static_cast<double>(random.below(3)), 1, 1};
      return random.below(3) > 0 ? spot : spot + std::pow(10, random.uniform(-18, 0.3)) * random.in_cube(1);
    };
    std::vector<Vec3> points;
    for (int p = 0; p < 200; ++p) points.push_back(place());
    HierarchyParams params;
    params.radius = 1;
    Hierarchy hierarchy(params);
    hierarchy.build(points, box);
    PointTree tree(hierarchy.view());
    for (int step = 0; step < 30; ++step) {
      std::vector<std::int32_t> changed;
      for (std::size_t change = random.below(20); change > 0; --change) {
        const auto id = static_cast<std::int32_t>(random.below(hierarchy.capacity()));
        changed.push_back(id);
        if (hierarchy.contains(id)) hierarchy.remove(id);
        if (random.below(2) > 0) changed.push_back(hierarchy.insert(place()));
      }
      tree.update(hierarchy.view(), changed);
      const std::string what = "scene " + std::to_string(k) + ", step " + std::to_string(step);
      ASSERT_NO_FATAL_FAILURE(check_kept_tree(tree, ids_of(hierarchy.view()), what));
      ASSERT_LE(depth_of(tree), 80) << what;  // 60 of distances, 8 of points on a spot
    }
  }
}

/// Points that come far from all others, in ever smaller and ever larger places: nets of before hold no one
/// up.
TEST(KeptPointTrees, FollowPointsThatGoElsewhere) {
  for (const double factor : {0.5, 1.5}) {
    MovingPoints scene(3000, Box::none(), 79);
    PointTree tree(scene.hierarchy->view());
    double size = factor < 1 ? 1e6 : 1;
    for (int step = 0; step < 60; ++step, size *= factor) {
      std::vector<std::int32_t> changed;
      for (int k = 0; k < 200; ++k)
        changed.push_back(scene.replace(scene.random.in_cube(size) + Vec3{1e5 * step, 0, 0}));
      tree.update(scene.hierarchy->view(), changed);
      const std::string what = "factor " + std::to_string(factor) + ", step " + std::to_string(step);
      ASSERT_NO_FATAL_FAILURE(check_kept_tree(tree, ids_of(scene.hierarchy->view()), what));
      std::int32_t most = 0;
      for (const PointTree::Node& node : tree.nodes()) most = std::max(most, node.children);
      ASSERT_LE(most, 60) << what;
    }
    EXPECT_EQ(tree.work().builds, 1);
  }
}

/// Halves of spots go on being halved as points come.
TEST(KeptPointTrees, HaveFewLevelsOfPointsThatCoincide) {
  Hierarchy hierarchy = liquid(8, Box::none());
  PointTree tree(hierarchy.view());
  for (int step = 0; step < 30; ++step) {
    std::vector<std::int32_t> changed;
    for (int k = 0; k < 30; ++k) changed.push_back(hierarchy.insert({3, 3, 3}));
    tree.update(hierarchy.view(), changed);
  }
  EXPECT_EQ(tree.work().builds, 1);
  EXPECT_LE(depth_of(tree), 24);
}

/// The node above a set of points and one far away is a ball between them.
TEST(KeptPointTrees, PutBallsBetweenWhatTheyHold) {
  for (const Box& box : {Box::none(), Box::orthorhombic({100, 100, 100})}) {
    MovingPoints scene(400, box, 82);
    for (Vec3& p : scene.positions) p = Vec3{9, 9, 9} + scene.random.in_cube(1);
    scene.hierarchy->build(scene.positions, box);
    PointTree tree(scene.hierarchy->view());
    tree.update(scene.hierarchy->view(), std::vector<std::int32_t>{scene.hierarchy->insert({9, 49, 9})});
    EXPECT_EQ(tree.work().builds, 1);
    EXPECT_EQ(tree.node(0).children, 2);
    EXPECT_LE(tree.node(0).radius, 22);
  }
}

TEST(KeptPointTrees, AreTheSameWhetherToldOrNot) {
  MovingPoints scene(2000, Box::orthorhombic({12, 12, 12}), 80);
  PointTree tree(scene.hierarchy->view()), told(scene.hierarchy->view());
  for (int step = 0; step < 30; ++step) {
    std::vector<std::int32_t> changed = scene.exchange(30);
    std::reverse(changed.begin(), changed.end());
    changed.push_back(changed.front());
    tree.update(scene.hierarchy->view());
    told.update(scene.hierarchy->view(), changed);
    ASSERT_EQ(tree.nodes().size(), told.nodes().size());
    for (std::size_t k = 0; k < tree.nodes().size(); ++k) {
      const PointTree::Node &a = tree.nodes()[k], &b = told.nodes()[k];
      ASSERT_EQ(a.representative, b.representative) << "step " << step << ", node " << k;
      ASSERT_EQ(a.radius, b.radius) << "step " << step << ", node " << k;
      ASSERT_EQ(a.reach, b.reach) << "step " << step << ", node " << k;
    }
  }
}

/// Whatever ids are named: of another box, of fewer ids, of no points, of new ids.
TEST(KeptPointTrees, TakeAllPointsOfAnotherBoxOrFewerIds) {
  const std::vector<std::int32_t> none;
  MovingPoints scene(200, Box::orthorhombic({10, 10, 10}), 81);
  Hierarchy& hierarchy = *scene.hierarchy;
  PointTree tree(hierarchy.view());
  const auto check = [&](const char* what) {
    tree.update(hierarchy.view(), none);
    ASSERT_NO_FATAL_FAILURE(check_kept_tree(tree, ids_of(hierarchy.view()), what));
    EXPECT_EQ(tree.capacity(), hierarchy.capacity()) << what;
    EXPECT_EQ(tree.box(), hierarchy.box()) << what;
  };
  hierarchy.update(scene.positions, Box::orthorhombic({10, 10, 9.5}));
  check("another box");
  hierarchy.insert({1, 2, 3});
  check("a new id");
  hierarchy.build({scene.positions.data(), 190}, hierarchy.box());
  check("fewer ids");
  hierarchy.build({}, hierarchy.box());
  check("no points");
  hierarchy.insert({1, 2, 3});
  check("one point");
  hierarchy.insert({4, 2, 3});
  check("two points");
}

TEST(KeptPointTrees, RefuseIdsThatCannotBe) {
  Hierarchy hierarchy = liquid(4, Box::none());
  PointTree tree(hierarchy.view());
  hierarchy.remove(5);
  for (const std::int32_t id : {-1, 64}) {
    const std::vector<std::int32_t> changed{5, id};
    const std::string message =
        test::message_of<InvalidParameter>([&] { tree.update(hierarchy.view(), changed); });
    EXPECT_NE(message.find("point " + std::to_string(id)), std::string::npos) << message;
  }
  EXPECT_TRUE(tree.contains(5));
  EXPECT_EQ(tree.size(), 64u);
}

}  // namespace

void check_kept_point_tree(ProximityScene& scene, PointTree& kept) {
  kept.update(scene.view());
  check_kept_tree(kept, scene.ids(), scene.what());
}

}  // namespace dch
