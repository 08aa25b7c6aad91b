// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <vector>

#include <dch/necklace/enclosing_ball.hpp>

#include "ball_scenes.hpp"

namespace {

using dch::Vec3;
using dch::necklace::Ball;
using dch::necklace::Basis;
using dch::necklace::enclosing_ball;
using dch::necklace::EnclosingBall;

double far_side(Vec3 center, const Ball& ball) {
  return std::sqrt(norm2(ball.center - center)) + ball.radius;
}

std::vector<Ball> basis_balls(const std::vector<Ball>& balls, const EnclosingBall& found) {
  std::vector<Ball> basis;
  for (const std::int32_t k : found.basis.indices()) basis.push_back(balls[static_cast<std::size_t>(k)]);
  return basis;
}

/// What has to hold of any answer: all inside, the basis touched, its indices ascending, and the ball of the
/// basis as large as that of all.
void check(const std::vector<Ball>& balls, const EnclosingBall& found) {
  for (const Ball& ball : balls) {
    EXPECT_LE(far_side(found.ball.center, ball), found.ball.radius * (1 + 2e-13));
  }
  ASSERT_GE(found.basis.size, 1);
  ASSERT_LE(found.basis.size, 4);
  const auto indices = found.basis.indices();
  EXPECT_TRUE(std::is_sorted(indices.begin(), indices.end()));
  const std::vector<Ball> basis = basis_balls(balls, found);
  // The center is rounded to where it lies.
  const double rounding = 1e-9 * found.ball.radius + 1e-15 * std::sqrt(norm2(found.ball.center));
  for (const Ball& ball : basis) {
    EXPECT_NEAR(far_side(found.ball.center, ball), found.ball.radius, rounding);
  }
  EXPECT_NEAR(enclosing_ball(basis).ball.radius, found.ball.radius, rounding);
}

TEST(EnclosingBall, OfNothingIsNothing) {
  const EnclosingBall found = enclosing_ball({});
  EXPECT_EQ(found.basis.size, 0);
  EXPECT_EQ(found.ball.radius, 0);
}

TEST(EnclosingBall, OfOneBallIsThatBall) {
  const std::vector<Ball> one{{{1, 2, 3}, 0.5}};
  const EnclosingBall found = enclosing_ball(one);
  EXPECT_EQ(found.ball.center, one[0].center);
  EXPECT_EQ(found.ball.radius, 0.5);
  EXPECT_EQ(found.basis, (Basis{{0, -1, -1, -1}, 1}));
}

TEST(EnclosingBall, OfTwoBallsSpansBoth) {
  const std::vector<Ball> two{{{0, 0, 0}, 1}, {{4, 0, 0}, 2}};
  const EnclosingBall found = enclosing_ball(two);
  EXPECT_DOUBLE_EQ(found.ball.radius, 3.5);
  EXPECT_DOUBLE_EQ(found.ball.center.x, 2.5);
  EXPECT_EQ(found.basis.size, 2);
}

TEST(EnclosingBall, OfABallWithinAnotherIsTheOther) {
  const std::vector<Ball> two{{{0.5, 0, 0}, 0.5}, {{0, 0, 0}, 1}};  // touches from within
  const EnclosingBall found = enclosing_ball(two);
  EXPECT_DOUBLE_EQ(found.ball.radius, 1);
  EXPECT_EQ(found.basis, (Basis{{1, -1, -1, -1}, 1}));
}

TEST(EnclosingBall, HardScenes) {
  for (const auto& scene : dch::scenes::hard_balls()) {
    SCOPED_TRACE(scene.name);
    check(scene.balls, enclosing_ball(scene.balls));
  }
}

TEST(EnclosingBall, KnownRadii) {
  const auto scenes = dch::scenes::hard_balls();
  const auto radius = [&](const std::string& name) {
    const auto found =
        std::find_if(scenes.begin(), scenes.end(), [&](const auto& scene) { return scene.name == name; });
    return enclosing_ball(found->balls).ball.radius;
  };
  EXPECT_NEAR(radius("on a circle"), 1.1, 1e-4) << "the points of the circle leave small gaps";
  EXPECT_NEAR(radius("on a line"), 0.49 + 0.5 * 199 * std::sqrt(0.59), 1e-10);
  EXPECT_DOUBLE_EQ(radius("coincident"), 0.5);
  EXPECT_EQ(radius("coincident points"), 0);
  EXPECT_NEAR(radius("touching one another from within"), 5, 1e-12);
  EXPECT_NEAR(radius("grid"), 0.49 + 1.5 * std::sqrt(3.0), 1e-12);
}

TEST(EnclosingBall, AnyGuessGivesTheSameBall) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto balls = dch::scenes::random_balls(40, 0.5, 20, seed);
    const double radius = enclosing_ball(balls).ball.radius;
    dch::scenes::Random random(seed);
    for (int size = 1; size <= 4; ++size) {
      Basis guess;
      guess.size = size;
      for (int k = 0; k < size; ++k) {
        guess.members[static_cast<std::size_t>(k)] =
            static_cast<std::int32_t>(10 * k + int(random.below(10)));
      }
      const EnclosingBall found = enclosing_ball(balls, guess);
      EXPECT_NEAR(found.ball.radius, radius, 1e-12 * radius) << "seed " << seed << ", guess of " << size;
      check(balls, found);
    }
  }
}

/// Centers, in the plane z = 0, of balls of the given radius that two balls touch from within: none or two.
std::vector<Vec3> centers_touching(const Ball& v, const Ball& w, double radius) {
  const Vec3 d = w.center - v.center;
  const double length = std::sqrt(norm2(d)), to_v = radius - v.radius, to_w = radius - w.radius;
  const double along = (length * length + to_v * to_v - to_w * to_w) / (2 * length);
  const double aside2 = to_v * to_v - along * along;
  if (to_v < 0 || to_w < 0 || !(aside2 >= 0)) return {};
  const Vec3 e = (1 / length) * d, f{-e.y, e.x, 0};
  const Vec3 foot = v.center + along * e;
  return {foot + std::sqrt(aside2) * f, foot - std::sqrt(aside2) * f};
}

/// Welzl's recursion takes it that a ball B outside of the least ball that V touches and U is inside of,
/// touches the least ball that V touches and U and B are inside of. With two balls in V and one in U, all in
/// a plane, that is wrong.
TEST(EnclosingBall, WelzlsStepIsWrongForDifferentRadii) {
  const Ball v{{18, 12, 0}, 1}, w{{7, 8, 0}, 8}, u{{0, 14, 0}, 3}, b{{15, 1, 0}, 1};
  const auto least = [&](const std::vector<Ball>& inside) {
    for (double radius = 0; radius < 100; radius += 0.001) {
      for (const Vec3 center : centers_touching(v, w, radius)) {
        const auto fits = [&](const Ball& ball) { return far_side(center, ball) <= radius; };
        if (std::all_of(inside.begin(), inside.end(), fits)) return Ball{center, radius};
      }
    }
    return Ball{};
  };
  const Ball without = least({u});
  EXPECT_NEAR(without.radius, 11.27, 0.01);
  EXPECT_GT(far_side(without.center, b), without.radius + 2) << "B is outside";
  const Ball with = least({u, b});
  EXPECT_NEAR(with.radius, 61.16, 0.01);
  EXPECT_LT(far_side(with.center, b), with.radius - 11) << "and yet does not touch";
  check({v, w, u, b}, enclosing_ball(std::vector<Ball>{v, w, u, b}));
}

}  // namespace
