// SPDX-License-Identifier: MIT
//
// Closest pairs in scenes in which everything is random, against all pairs: after motion, while a repair is
// put off, after insertions and removals.
#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/closest_pair.hpp>
#include <dch/proximity/point_tree.hpp>

#include "effort.hpp"
#include "liquid.hpp"
#include "proximity_checks.hpp"
#include "proximity_scene.hpp"
#include "scenes.hpp"
#include "special_numbers.hpp"

namespace dch {
namespace {

TEST(ClosestPairs, EqualAllPairsInRandomScenes) {
  for (int k = 0; k < effort(600); ++k) {
    ProximityScene scene(7000000 + static_cast<std::uint64_t>(k), 200);
    for (int step = 0; step < 4; ++step) {
      ASSERT_NO_FATAL_FAILURE(check_closest_pair(scene)) << "step " << step;
      scene.change(step);
    }
  }
}

TEST(ClosestPairs, LookAtFewPairsOfNodesForEachPoint) {
  const Box box = Box::none();
  EXPECT_LE(closest_pair(PointTree(liquid(12, box).view())).looked_at, 15 * 12 * 12 * 12);
  EXPECT_LE(closest_pair(PointTree(liquid(24, box).view())).looked_at, 17 * 24 * 24 * 24);
  HierarchyParams params;
  params.radius = 1;
  Hierarchy coincident(params);
  coincident.build(scenes::coincident(box, 20000), box);
  const ClosestPoints found = closest_pair(PointTree(coincident.view()));
  EXPECT_LE(found.looked_at, 21000);
  EXPECT_EQ(std::pair(found.a, found.b), std::pair(0, 1));
}

TEST(ClosestPairs, OfFewerThanTwoPointsThereAreNone) {
  HierarchyParams params;
  params.radius = 1;
  Hierarchy hierarchy(params);
  for (const std::size_t n : {0, 1}) {
    hierarchy.build(scenes::coincident(Box::none(), n), Box::none());
    const ClosestPoints found = closest_pair(PointTree(hierarchy.view()));
    EXPECT_EQ(std::tuple(found.a, found.b, found.distance2), std::tuple(-1, -1, kInfinity));
  }
}

}  // namespace

void check_closest_pair(ProximityScene& scene) { check_closest_pair(scene, PointTree(scene.view())); }

void check_closest_pair(ProximityScene& scene, const PointTree& tree) {
  const std::vector<std::int32_t> ids = scene.ids();
  std::tuple<double, std::int32_t, std::int32_t> expected{kInfinity, -1, -1};
  for (std::size_t p = 0; p < ids.size(); ++p)
    for (std::size_t q = p + 1; q < ids.size(); ++q)
      expected = std::min(expected, {tree.distance2(ids[p], ids[q]), ids[p], ids[q]});
  const ClosestPoints found = closest_pair(tree);
  ASSERT_EQ(std::tuple(found.distance2, found.a, found.b), expected) << scene.what();
}

}  // namespace dch
