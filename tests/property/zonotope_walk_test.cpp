// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/zonotope/face_walk.hpp>
#include <dch/zonotope/norm.hpp>

#include "effort.hpp"
#include "hull_tree.hpp"
#include "random_zonotope.hpp"
#include "zonotope_scenes.hpp"

namespace dch::zonotope {
namespace {

TEST(HullTrees, GiveTheTangentsOfAllPoints) {
  scenes::Random random(81);
  for (int n = 0; n < effort(40); ++n) {
    std::vector<Vec2> points;
    for (int k = 0; k < 3 + n; ++k) points.push_back({random.uniform(-1, 1), random.uniform(-1, 1)});
    std::sort(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
    HullTree lower(points, false), upper(points, true);
    std::vector<bool> is_in(points.size(), false);
    lower.assign(is_in);
    upper.assign(is_in);
    for (int change = 0; change < 60; ++change) {
      const std::size_t k = random.below(points.size());
      is_in[k] = !is_in[k];
      is_in[k] ? lower.insert(k) : lower.erase(k);
      is_in[k] ? upper.insert(k) : upper.erase(k);
      const std::size_t from = random.below(points.size());
      for (const bool is_rising : {false, true})
        for (const bool is_right : {false, true}) {
          const HullTree& tree = is_rising == is_right ? lower : upper;
          const std::size_t first = is_right ? from + 1 : 0, last = is_right ? points.size() : from;
          std::size_t best = HullTree::kNone;
          const auto slope = [&](std::size_t p) {
            return (points[p].y - points[from].y) / (points[p].x - points[from].x);
          };
          for (std::size_t p = first; p < last; ++p)
            if (is_in[p] && (best == HullTree::kNone || (slope(p) < slope(best)) == is_rising)) best = p;
          ASSERT_EQ(tree.first_met(from, first, last, is_rising), best);
        }
    }
  }
}

TEST(FaceWalks, FollowTheNormOfAMovingPoint) {
  scenes::Random random(82);
  std::int64_t steps = 0, searches = 0, moves = 0;
  for (int n = 0; n < effort(40); ++n) {
    const Zonotope z = random_zonotope(random, 3 + 4 * random.below(12));
    FaceWalk walk(z);
    Vec3 x = z.center + random.in_cube(5);
    for (int k = 0; k < 50; ++k) {
      x = k % 10 == 9 ? z.center + random.in_cube(5) : x + random.in_cube(0.3);  // near, and anywhere
      const double expected = norm(z, x - z.center);
      ASSERT_NEAR(walk.move_to(x), expected, 1e-10 * expected) << n << ", " << k;
      const Vec3 normal = walk.normal();
      EXPECT_NEAR(dot(normal, x - z.center), expected * support({{}, z.generators}, normal), 1e-9);
      ++moves;
    }
    steps += walk.stats().steps;
    searches += walk.stats().searches - 1;
  }
  std::printf("%.2f steps a move, %ld searches in %ld moves\n",
              static_cast<double>(steps) / static_cast<double>(moves), long(searches), long(moves));
  EXPECT_LT(searches, moves / 100);
}

TEST(FaceWalks, TakeCoplanarAndParallelGenerators) {
  scenes::Random random(83);
  using scenes::GeneratorKind;
  for (const auto kind : {GeneratorKind::axes, GeneratorKind::coplanar, GeneratorKind::parallel,
                          GeneratorKind::vertical, GeneratorKind::few_directions})
    for (int n = 0; n < effort(10); ++n) {
      Zonotope z{{}, scenes::grid_generators(random, kind, 9)};
      FaceWalk walk(z);
      for (int k = 0; k < 20; ++k) {
        const Vec3 x = random.in_cube(5);
        EXPECT_NEAR(walk.move_to(x), norm(z, x), 1e-9 * norm(z, x)) << static_cast<int>(kind);
      }
    }
}

TEST(FaceWalks, AStepTakesPolylogarithmicWork) {
  scenes::Random random(84);
  double least = INFINITY, most = 0;
  for (std::size_t n = 64; n <= 4096; n *= 4) {
    const Zonotope z = random_zonotope(random, n);
    FaceWalk walk(z);
    const Vec3 axis = random.in_ball(1), start = random.in_ball(1);
    const std::int64_t steps = walk.stats().steps, operations = walk.stats().operations;
    for (int k = 0; k < 300; ++k) walk.move_to(z.center + start + 0.3 * k / static_cast<double>(n) * axis);
    const double lg = std::log2(static_cast<double>(n));
    const double per_step = static_cast<double>(walk.stats().operations - operations) /
                            static_cast<double>(walk.stats().steps - steps);
    std::printf("n = %zu: %ld steps, %.1f operations a step, %.2f lg^2 n, %.3f lg^3 n\n", n,
                long(walk.stats().steps - steps), per_step, per_step / (lg * lg), per_step / (lg * lg * lg));
    EXPECT_GT(walk.stats().steps - steps, 20);
    least = std::min(least, per_step / (lg * lg));
    most = std::max(most, per_step / (lg * lg));
  }
  EXPECT_LT(most, 3 * least);
}

TEST(FaceWalks, RefuseWhatIsFlat) {
  EXPECT_THROW(FaceWalk({{}, {{1, 0, 0}, {0, 1, 0}}}), InvalidParameter);
  EXPECT_THROW(FaceWalk({{}, {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}), InvalidParameter);
  FaceWalk walk({{1, 1, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  EXPECT_THROW(walk.move_to({NAN, 0, 0}), InvalidPosition);
  EXPECT_EQ(walk.move_to({1, 1, 1}), 0);
  EXPECT_DOUBLE_EQ(walk.move_to({1, 1, 4}), 3);
  EXPECT_EQ(walk.zonotope().generators.size(), 3u);
  EXPECT_NE(walk.first_generator(), walk.second_generator());
}

}  // namespace
}  // namespace dch::zonotope
