// SPDX-License-Identifier: MIT
//
// Cluster pairs in small scenes, each at the edge of one thing: the last digits of the cutoff, ghosts alone,
// the order of points that is kept from search to search.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <utility>
#include <vector>

#include <dch/engines/pair_search.hpp>

#include "cluster_pair_check.hpp"
#include "list_params.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

/// Two nodes far apart, the points in turns in one and in the other one.
struct TwoNodes {
  explicit TwoNodes(int others) : hierarchy(hierarchy_of(points, Box::none(), 1, 1)) {
    for (int k = 0; k < others; ++k) add();
  }
  void add() {
    points.push_back(points[points.size() % 2] + random.in_ball(0.9));
    hierarchy.insert(points.back());
  }
  std::vector<Vec3> points{{0, 0, 0}, {30, 0, 0}};
  scenes::Random random{12};
  ListedHierarchy hierarchy;
};

TEST(ClusterPairsEdges, GhostsAloneMakeNoPairs) {
  const std::vector<Vec3> points = scenes::uniform(60, {2, 2, 2}, 4);
  ListedHierarchy hierarchy = hierarchy_of(points, Box::none(), 1);
  ListParams request = within(1);
  for (const std::int32_t first_ghost : {0, 1, 59, 60}) {
    request.first_ghost = first_ghost;
    ClusterPairs pairs;
    hierarchy.cluster_pairs(request, pairs);
    EXPECT_EQ(cluster_pair_fault(pairs, points, Box::none(), request), "") << first_ghost;
    EXPECT_EQ(pairs.entries.empty(), first_ghost == 0);
  }
}

// Coordinates are 16-bit integers relative to a node: no pair at the cutoff is lost to that, and none is kept
// that is a thousandth beyond.
TEST(ClusterPairsEdges, RoundingLosesNoPairAtTheCutoffAndKeepsFewBeyond) {
  scenes::Random random(21);
  for (int trial = 0; trial < 400; ++trial) {
    Vec3 direction = random.in_ball(1);
    direction = 1 / std::sqrt(norm2(direction)) * direction;
    // Each point is 0.9 from the center of its node, and the centers are on the same line.
    const Vec3 start = random.in_cube(5);
    const bool with_others = trial % 2 == 0;
    for (const double beyond : {0.0, 1e-3}) {
      std::vector<Vec3> points{start, start + (2.8 + beyond) * direction};
      if (!with_others) points = {start, start + (1 + beyond) * direction};
      if (with_others) {
        points.push_back(start + 0.9 * direction);
        points.push_back(start + (1.9 + beyond) * direction);
      }
      ListedHierarchy hierarchy = hierarchy_of(points, Box::none(), 1, with_others ? 0.95 : 0.5);
      ListParams request = within(1);
      ClusterPairs pairs;
      hierarchy.cluster_pairs(request, pairs);
      std::int64_t across = 0;
      pairs.for_each([&](std::int32_t i, std::int32_t j, Vec3) {
        across += (i < j ? i : j) % 2 != (i < j ? j : i) % 2;
      });
      ASSERT_EQ(across > 0, beyond == 0) << trial;
    }
  }
}

// Engines keep no positions in blocks: clusters are cut from the positions as given, in other images too.
TEST(ClusterPairsEdges, OfEnginesAreThoseOfThePositionsAsGiven) {
  for (const Box& box :
       {Box::none(), Box::orthorhombic({6, 6, 6}), Box::triclinic({6, 0, 0}, {2, 6, 0}, {-1, 1.5, 6})}) {
    std::vector<Vec3> points = scenes::uniform(500, {6, 6, 6}, 9);
    scenes::Random random(10);
    const auto search = make_search("dch", {1.2, MaintenancePolicy::automatic});
    for (int step = 0; step < 6; ++step) {
      search->update(points, box);
      ClusterPairs pairs;
      search->cluster_pairs(within(1.2), pairs);
      ASSERT_EQ(cluster_pair_fault(pairs, points, box, within(1.2)), "") << step;
      for (Vec3& point : points) point = point + random.in_ball(0.3);
    }
  }
}

// Points that change places within a node keep the order in which they were cut into clusters, each of its
// nodes for eight searches.
TEST(ClusterPairsEdges, OrdersOfPointsAreGoodForEightSearches) {
  TwoNodes nodes(40);
  ListedHierarchy& hierarchy = nodes.hierarchy;
  std::vector<Vec3> moved = nodes.points;
  std::reverse(moved.begin() + 2, moved.end());  // each to its own node, since they are in turns
  for (std::size_t k = 2; k + 1 < moved.size(); k += 2) std::swap(moved[k], moved[k + 1]);
  ClusterPairs pairs;
  hierarchy.cluster_pairs(within(1), pairs);
  ASSERT_EQ(pairs.origin.size(), 2u);
  const std::vector<std::int32_t> first = pairs.particle;
  const std::size_t half = first.size() / 2;
  const auto is_kept = [&](std::size_t from) {
    const auto begin = static_cast<std::ptrdiff_t>(from);
    return std::equal(first.begin() + begin, first.begin() + begin + static_cast<std::ptrdiff_t>(half),
                      pairs.particle.begin() + begin);
  };
  hierarchy.update(moved, Box::none());
  for (int search = 2; search <= 9; ++search) {
    hierarchy.cluster_pairs(within(1), pairs);
    ASSERT_EQ(cluster_pair_fault(pairs, moved, Box::none(), within(1)), "");
    ASSERT_EQ(pairs.particle.size(), first.size());
    EXPECT_EQ(is_kept(0), search <= 8) << search;
    EXPECT_EQ(is_kept(half), search <= 8) << search;
  }
}

TEST(ClusterPairsEdges, OrdersOfPointsAreNotKeptWhenTheyComeAndGo) {
  TwoNodes nodes(24);
  ClusterPairs pairs;
  for (int step = 0; step < 12; ++step) {
    nodes.hierarchy.cluster_pairs(within(1), pairs);
    ASSERT_EQ(cluster_pair_fault(pairs, nodes.points, Box::none(), within(1)), "") << step;
    nodes.add();
  }
}

TEST(ClusterPairsEdges, OrdersOfPointsAreNotKeptForOtherPointsAsMany) {
  TwoNodes nodes(24);
  ClusterPairs pairs;
  nodes.hierarchy.cluster_pairs(within(1), pairs);
  std::swap(nodes.points[4], nodes.points[5]);
  nodes.hierarchy.update(nodes.points, Box::none());
  nodes.hierarchy.cluster_pairs(within(1), pairs);
  EXPECT_EQ(cluster_pair_fault(pairs, nodes.points, Box::none(), within(1)), "");
}

TEST(ClusterPairsEdges, OrdersOfPointsAreNotKeptForThoseThatAreLeft) {
  TwoNodes nodes(10);
  ClusterPairs pairs;
  for (std::int32_t last = 11; last > 3; --last) {
    nodes.hierarchy.cluster_pairs(within(1), pairs);
    std::vector<std::int32_t> particles = pairs.particle;
    particles.erase(std::remove(particles.begin(), particles.end(), -1), particles.end());
    std::sort(particles.begin(), particles.end());
    std::vector<std::int32_t> expected(static_cast<std::size_t>(last + 1));
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(particles, expected);
    nodes.hierarchy.remove(last);
  }
}

// The box of the first node comes within the cutoff of the third point, none of its points does, nor of each
// other.
TEST(ClusterPairsEdges, ClustersAreNoPairUnlessPointsOfTheirsAre) {
  const std::vector<Vec3> points{{0, 0, 0}, {0.5, 0.5, 0}, {0.7, -0.2, 0}};
  ListedHierarchy hierarchy = hierarchy_of(points, Box::none(), 0.3, 0.72);
  ClusterPairs pairs;
  hierarchy.cluster_pairs(within(0.3), pairs);
  ASSERT_EQ(pairs.origin.size(), 2u);
  EXPECT_TRUE(pairs.entries.empty());
}

TEST(ClusterPairsEdges, CutoffsByTypesAreNotLookedAtWhereRadiiAreGiven) {
  const std::vector<Vec3> points = scenes::uniform(60, {2, 2, 2}, 4);
  const std::vector<double> radii(points.size(), 0.5);
  ListedHierarchy hierarchy = hierarchy_of(points, Box::none(), 1);
  ListParams request;
  request.radii = radii;
  request.cutoffs = TypeCutoffs(2, {0, 1, 1, 1});
  ClusterPairs pairs;
  hierarchy.cluster_pairs(request, pairs);
  EXPECT_EQ(cluster_pair_fault(pairs, points, Box::none(), request), "");
}

}  // namespace
}  // namespace dch
