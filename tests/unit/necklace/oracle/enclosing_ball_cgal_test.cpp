// SPDX-License-Identifier: MIT
// Minimum enclosing balls against those of CGAL, whose library is GPL-3.0-or-later; so is this test once
// compiled.
#include <CGAL/Cartesian.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include <dch/necklace/enclosing_ball.hpp>

#include "ball_scenes.hpp"
#include "effort.hpp"

namespace {

using Traits = CGAL::Min_sphere_of_spheres_d_traits_3<CGAL::Cartesian<double>, double>;
using MinSphere = CGAL::Min_sphere_of_spheres_d<Traits>;
using dch::necklace::Ball;
using dch::necklace::enclosing_ball;

double cgal_radius(const std::vector<Ball>& balls) {
  std::vector<Traits::Sphere> spheres;
  for (const Ball& ball : balls) {
    spheres.emplace_back(Traits::Point(ball.center.x, ball.center.y, ball.center.z), ball.radius);
  }
  MinSphere sphere(spheres.begin(), spheres.end());
  return sphere.radius();
}

TEST(EnclosingBallAgainstCgal, HardScenes) {
  for (const auto& scene : dch::scenes::hard_balls()) {
    const double expected = cgal_radius(scene.balls);
    EXPECT_NEAR(enclosing_ball(scene.balls).ball.radius, expected, 1e-8 * expected) << scene.name;
  }
}

TEST(EnclosingBallAgainstCgal, RandomBallsOfAnyRadii) {
  for (int seed = 1; seed <= dch::effort(3000); ++seed) {
    dch::scenes::Random random(static_cast<std::uint64_t>(seed));
    const std::size_t count = 1 + random.below(seed % 10 == 0 ? 300 : 12);
    const double ratio = std::pow(20, random.uniform());
    const double largest = std::pow(10, random.uniform(-3, 0.5));
    const auto balls = dch::scenes::random_balls(count, largest, ratio, random.below(1U << 30));
    const double expected = cgal_radius(balls);
    EXPECT_NEAR(enclosing_ball(balls).ball.radius, expected, 1e-11 * expected) << "seed " << seed;
  }
}

TEST(EnclosingBallAgainstCgal, BallsAlongRandomWalks) {
  for (int seed = 1; seed <= dch::effort(300); ++seed) {
    dch::scenes::Random random(static_cast<std::uint64_t>(seed));
    std::vector<Ball> walk{{{}, 0.5}};
    for (int k = 0; k < 500; ++k)
      walk.push_back({walk.back().center + random.in_ball(1), random.uniform(0.1, 1)});
    const double expected = cgal_radius(walk);
    EXPECT_NEAR(enclosing_ball(walk).ball.radius, expected, 1e-12 * expected) << "seed " << seed;
  }
}

}  // namespace
