// SPDX-License-Identifier: MIT
//
// Centers in scenes in which everything is random, against all pairs: after motion, while a repair is put
// off, after insertions and removals.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/k_center.hpp>
#include <dch/proximity/point_tree.hpp>

#include "effort.hpp"
#include "error_message.hpp"
#include "hierarchy/structure_params.hpp"
#include "liquid.hpp"
#include "proximity_checks.hpp"
#include "proximity_scene.hpp"
#include "scenes.hpp"
#include "special_numbers.hpp"

namespace dch {
namespace {

/// The squared distance of the farthest point from the nearest of some centers.
double covering2(const PointTree& tree, const std::vector<std::int32_t>& ids,
                 const std::vector<std::int32_t>& centers) {
  double most = 0;
  for (const std::int32_t id : ids) {
    double least = kInfinity;
    for (const std::int32_t center : centers) least = std::min(least, tree.distance2(center, id));
    most = std::max(most, least);
  }
  return most;
}

/// The least covering radius that k of the points have, for all k, by trying all sets of centers.
std::vector<double> best_radii(const PointTree& tree, const std::vector<std::int32_t>& ids) {
  std::vector<double> best(ids.size() + 1, kInfinity);
  for (unsigned set = 1; set < 1u << ids.size(); ++set) {
    std::vector<std::int32_t> centers;
    for (std::size_t k = 0; k < ids.size(); ++k)
      if ((set >> k & 1) == 1) centers.push_back(ids[k]);
    best[centers.size()] = std::min(best[centers.size()], std::sqrt(covering2(tree, ids, centers)));
  }
  return best;
}

std::vector<std::int64_t> up_to(std::size_t n) {
  std::vector<std::int64_t> k(n);
  std::iota(k.begin(), k.end(), 1);
  return k;
}

void check_radii(const PointTree& tree, const std::vector<std::int32_t>& ids,
                 const std::vector<std::int64_t>& k, const KCenters& found, const std::string& what) {
  ASSERT_EQ(found.radius.size(), k.size()) << what;
  std::vector<std::int32_t> sorted = found.centers;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_TRUE(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) << what;
  ASSERT_TRUE(std::includes(ids.begin(), ids.end(), sorted.begin(), sorted.end())) << what;
  for (std::size_t q = 0; q < k.size(); ++q) {
    ASSERT_LE(static_cast<std::size_t>(k[q]), found.centers.size()) << what;
    const std::vector<std::int32_t> first(found.centers.begin(), found.centers.begin() + k[q]);
    ASSERT_EQ(found.radius[q], std::sqrt(covering2(tree, ids, first))) << what << ", k = " << k[q];
  }
}

/// @param worst ratio to the optimum so far
void check_against_best(const PointTree& tree, ProximityScene& scene, double& worst) {
  const std::vector<std::int32_t> ids = scene.ids();
  const std::vector<std::int64_t> all = up_to(ids.size());
  const KCenters found = k_centers(tree, all);
  ASSERT_NO_FATAL_FAILURE(check_radii(tree, ids, all, found, scene.what()));
  const std::vector<double> best = best_radii(tree, ids);
  for (std::size_t q = 0; q < all.size(); ++q) {
    ASSERT_LE(found.radius[q], 4 * best[q + 1] + 8 * tree.rounding()) << scene.what() << ", k = " << q + 1;
    if (best[q + 1] > 1e-3) worst = std::max(worst, found.radius[q] / best[q + 1]);
  }
}

void check_some(const PointTree& tree, ProximityScene& scene) {
  const std::vector<std::int32_t> ids = scene.ids();
  std::vector<std::int64_t> some;
  for (int q = 0; q < 4 && !ids.empty(); ++q)
    some.push_back(1 + static_cast<std::int64_t>(scene.random.below(ids.size())));
  check_radii(tree, ids, some, k_centers(tree, some), scene.what());
}

TEST(KCenters, AreWithinFourTimesTheOptimumOfSmallSets) {
  double worst = 0;
  for (int k = 0; k < effort(400); ++k) {
    ProximityScene scene(5000000 + static_cast<std::uint64_t>(k), 12);
    for (int step = 0; step < 3; step += 2) {
      ASSERT_NO_FATAL_FAILURE(check_against_best(PointTree(scene.view()), scene, worst)) << "step " << step;
      scene.change(step);
    }
  }
  EXPECT_GT(worst, 1.5);
  EXPECT_LE(worst, 4);
}

TEST(KCenters, HaveTheRadiusThatTheySayInRandomScenes) {
  int pending = 0;
  for (int k = 0; k < effort(200); ++k) {
    ProximityScene scene(6000000 + static_cast<std::uint64_t>(k), 200);
    for (int step = 0; step < 4; ++step) {
      pending += scene.view().repair_pending();
      ASSERT_NO_FATAL_FAILURE(check_some(PointTree(scene.view()), scene)) << "step " << step;
      scene.change(step);
    }
  }
  EXPECT_GT(pending, 20);
}

TEST(KCenters, OfPlacesThatAreFewerThanCentersHaveRadiusZero) {
  HierarchyParams params;
  params.radius = 1;
  Hierarchy hierarchy(params);
  std::vector<Vec3> points = scenes::coincident(Box::none(), 30);
  points.push_back(points[0] + Vec3{1, 0, 0});
  hierarchy.build(points, Box::none());
  const PointTree tree(hierarchy.view());
  const KCenters found = k_centers(tree, std::vector<std::int64_t>{31, 1, 2, 30});
  EXPECT_EQ(found.centers.size(), 31u);
  EXPECT_EQ(found.radius, (std::vector<double>{0, 1, 0, 0}));
  EXPECT_TRUE(k_centers(tree, {}).centers.empty());
}

// A net of a radius that is a distance of two points would not tell them apart.
TEST(KCenters, TellPointsApartWhoseDistancesAreRadiiOfNets) {
  detail::StructureParams params;
  params.radius = 1;
  params.base_radius = 1;
  Hierarchy hierarchy(params);
  hierarchy.build(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {7, 0, 0}}, Box::none());
  const PointTree tree(hierarchy.view());
  ASSERT_EQ(tree.base_radius(), 1);
  EXPECT_EQ(tree.nodes().back().points, 1);
  EXPECT_EQ(k_centers(tree, std::vector<std::int64_t>{3, 4}).radius, (std::vector<double>{1, 0}));
}

TEST(KCenters, LookAtFewNodesForEachCenter) {
  const PointTree tree(liquid(24, Box::none()).view());
  EXPECT_LE(k_centers(tree, std::vector<std::int64_t>{10}).looked_at, 14500);
  EXPECT_LE(k_centers(tree, std::vector<std::int64_t>{100}).looked_at, 157000);
  EXPECT_LE(k_centers(tree, std::vector<std::int64_t>{1000}).looked_at, 1030000);
}

TEST(KCenters, BadInputIsNamed) {
  const PointTree tree(liquid(2, Box::none()).view());
  const auto message = [&](std::int64_t k) {
    return test::message_of<InvalidParameter>([&] { k_centers(tree, std::vector<std::int64_t>{1, k}); });
  };
  EXPECT_THAT(message(0), testing::HasSubstr("0 centers of 8 points were asked for; ask for 1 to"));
  EXPECT_THAT(message(9), testing::HasSubstr("9 centers of 8 points"));
  EXPECT_THAT(message(-3), testing::HasSubstr("-3 centers"));
  HierarchyParams params;
  params.radius = 1;
  Hierarchy empty(params);
  empty.build(std::vector<Vec3>(), Box::none());
  EXPECT_THROW(k_centers(PointTree(empty.view()), std::vector<std::int64_t>{1}), InvalidParameter);
}

}  // namespace

void check_centers(ProximityScene& scene) { check_centers(scene, PointTree(scene.view())); }

void check_centers(ProximityScene& scene, const PointTree& tree) {
  if (scene.ids().size() > 12) return check_some(tree, scene);
  double worst = 0;
  check_against_best(tree, scene, worst);
}

}  // namespace dch
