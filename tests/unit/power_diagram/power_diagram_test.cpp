// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include <dch/necklace/walks.hpp>
#include <dch/power_diagram/power_diagram.hpp>

#include "effort.hpp"
#include "error_message.hpp"
#include "random.hpp"

namespace {

using dch::IndexPair;
using dch::InvalidParameter;
using dch::InvalidPosition;
using dch::Vec3;
using dch::necklace::Ball;
using dch::necklace::PowerDiagram;
using dch::scenes::Random;
using dch::test::message_of;
using testing::HasSubstr;

std::vector<Ball> balls_at(const std::vector<Vec3>& centers, double radius) {
  std::vector<Ball> balls;
  for (const Vec3& center : centers) balls.push_back({center, radius});
  return balls;
}

/// Pairs of balls of one radius whose diametral ball holds no third center: they have to share an edge.
std::vector<IndexPair> alone_in_their_ball(const std::vector<Ball>& balls) {
  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    for (std::size_t j = i + 1; j < balls.size(); ++j) {
      bool alone = true;
      for (std::size_t k = 0; k < balls.size() && alone; ++k) {
        if (k == i || k == j) continue;
        alone = dot(balls[i].center - balls[k].center, balls[j].center - balls[k].center) > 0;
      }
      if (alone) pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    }
  }
  return pairs;
}

/// With params that never build, or as they are.
PowerDiagram repairing() {
  dch::necklace::PowerDiagramParams params;
  params.most_removed = 1;
  return PowerDiagram(params);
}

TEST(PowerDiagram, HoldsEveryPairAloneInItsBall) {
  PowerDiagram kept = repairing();
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(dch::effort(60)); ++seed) {
    Random random(seed);
    std::vector<Ball> balls;
    for (int k = 0; k < 40; ++k) balls.push_back({random.in_cube(1), 0.1});
    kept.update(balls);
    EXPECT_THAT(kept.edges(), testing::IsSupersetOf(alone_in_their_ball(balls))) << "seed " << seed;
    EXPECT_TRUE(kept.coincident().empty());
  }
}

// After such motion hulls that are convex at each edge go around themselves twice, with few balls left; that
// of the seed 6238 turns all its facets towards its middle nevertheless.
TEST(PowerDiagram, RepairedIsTheSameAsBuiltAfterAnyMotion) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(dch::effort(300)); ++seed)
    seeds.push_back(seed);
  for (std::uint64_t seed = 6237; seed <= 6238; ++seed) seeds.push_back(seed);
  PowerDiagram kept = repairing();
  for (const std::uint64_t seed : seeds) {
    Random random(seed);
    std::vector<Ball> balls;
    for (int k = 0; k < 40; ++k) balls.push_back({random.in_cube(1), 0.1});
    kept.update(balls);
    PowerDiagram built;
    built.update(balls);
    ASSERT_EQ(kept.edges(), built.edges()) << "seed " << seed;
    ASSERT_TRUE(kept.is_valid()) << "seed " << seed;
  }
}

TEST(PowerDiagram, RepairedIsTheSameAsBuilt) {
  for (const double ratio : {1.0, 20.0}) {
    for (const double step : {1e-6, 1e-3, 1e-2, 0.3}) {
      Random random(7);
      std::vector<Ball> balls = balls_at(dch::necklace::globule(300, 0.3, 1).positions, 0.5);
      for (Ball& ball : balls) ball.radius *= std::pow(ratio, -random.uniform());
      PowerDiagram kept = repairing();
      for (int k = 0; k < dch::effort(12); ++k) {
        kept.update(balls);
        PowerDiagram built;
        built.update(balls);
        ASSERT_EQ(kept.edges(), built.edges()) << "ratio " << ratio << ", step " << step << ", update " << k;
        ASSERT_EQ(kept.stats().hidden, built.stats().hidden);
        ASSERT_TRUE(kept.is_valid());
        for (Ball& ball : balls) ball.center = ball.center + random.in_ball(step);
      }
      EXPECT_EQ(kept.stats().builds, 1) << "step " << step;
      EXPECT_EQ(kept.stats().repairs, dch::effort(12) - 1) << "step " << step;
    }
  }
}

TEST(PowerDiagram, BuildsWhereARepairWouldRemoveTooMuch) {
  const auto start = balls_at(dch::necklace::globule(300, 0.3, 1).positions, 0.5);
  dch::necklace::PowerDiagramParams params;
  params.most_removed = 0;
  PowerDiagram diagram(params);
  diagram.update(start);
  diagram.update(start);
  EXPECT_EQ(diagram.stats().builds, 1);
  EXPECT_EQ(diagram.stats().repairs, 1);
  diagram.update(balls_at(dch::necklace::globule(300, 0.3, 2).positions, 0.5));
  EXPECT_EQ(diagram.stats().builds, 2);
  EXPECT_EQ(diagram.stats().updates, 3);
}

TEST(PowerDiagram, BallsAtOnePlaceAreNamed) {
  PowerDiagram diagram;
  diagram.update(balls_at({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}, 0.1));
  EXPECT_EQ(diagram.stats().hidden, 2);
  const auto coincident = diagram.coincident();
  ASSERT_EQ(coincident.size(), 2U);
  EXPECT_EQ(coincident[0][1], coincident[1][1]);
  std::vector<std::int32_t> standing{coincident[0][0], coincident[1][0], coincident[0][1]};
  EXPECT_THAT(standing, testing::UnorderedElementsAre(0, 2, 5));
}

TEST(PowerDiagram, ABallWithoutACellIsHiddenButNoDouble) {
  std::vector<Ball> balls = balls_at({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {0.05, 0.05, 0.05}}, 1);
  balls[4].radius = 0.1;
  PowerDiagram diagram;
  diagram.update(balls);
  EXPECT_EQ(diagram.stats().hidden, 1);
  EXPECT_TRUE(diagram.coincident().empty());
  for (const auto& [a, b] : diagram.edges()) EXPECT_LT(b, 4) << a;
  balls[4].center = {2, 2, 2};  // comes out under motion
  diagram.update(balls);
  EXPECT_EQ(diagram.stats().hidden, 0);
}

TEST(PowerDiagram, RefusesBadInput) {
  dch::necklace::PowerDiagramParams params;
  params.most_removed = 1.5;
  EXPECT_THAT(message_of<InvalidParameter>([&] { PowerDiagram{params}; }), HasSubstr("1.5"));
  PowerDiagram diagram;
  EXPECT_THROW(diagram.update(balls_at({{0, 0, 0}, {0, INFINITY, 0}}, 1)), InvalidPosition);
  diagram.update({});
  EXPECT_TRUE(diagram.edges().empty());
}

}  // namespace
