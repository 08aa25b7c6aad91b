// SPDX-License-Identifier: MIT
#include <CGAL/Gmpq.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/zonotope/membership.hpp>
#include <dch/zonotope_fit/zonotope_fit.hpp>

#include "effort.hpp"
#include "error_message.hpp"
#include "random.hpp"

namespace dch::zonotope {
namespace {

std::vector<Coordinates> random_vectors(scenes::Random& random, std::size_t count, std::size_t dimension) {
  std::vector<Coordinates> result(count, Coordinates(dimension));
  for (Coordinates& v : result)
    for (double& x : v) x = random.uniform(-1, 1);
  return result;
}

/// The text's program, with coefficients b_ij for each point, solved in rationals.
double least_total_length(const std::vector<Coordinates>& points,
                          const std::vector<Coordinates>& unit_directions) {
  using Program = CGAL::Quadratic_program<double>;
  const int d = static_cast<int>(points[0].size()), k = static_cast<int>(unit_directions.size());
  const int n = static_cast<int>(points.size());
  Program program(CGAL::LARGER, false, 0, false, 0);  // lengths 0..k-1, then the center, then b_ij
  int row = 0;
  const auto b = [&](int i, int j) { return k + d + j * k + i; };
  for (int j = 0; j < n; ++j) {
    for (int axis = 0; axis < d; ++axis, ++row) {
      program.set_a(k + axis, row, 1);
      for (int i = 0; i < k; ++i) program.set_a(b(i, j), row, unit_directions[i][axis]);
      program.set_b(row, points[j][axis]);
      program.set_r(row, CGAL::EQUAL);
    }
    for (int i = 0; i < k; ++i)
      for (const double sign : {1.0, -1.0}) {
        program.set_a(i, row, 1);
        program.set_a(b(i, j), row, sign);
        program.set_b(row++, 0);
      }
  }
  for (int i = 0; i < k; ++i) program.set_c(i, 1);
  const auto solution = CGAL::solve_linear_program(program, CGAL::Gmpq());
  EXPECT_TRUE(solution.is_optimal());
  return CGAL::to_double(solution.objective_value());
}

Zonotope slightly_larger(Zonotope z) {
  for (Vec3& v : z.generators) v = (1 + 1e-12) * v;
  for (const Vec3 v : {Vec3{1e-12, 0, 0}, {0, 1e-12, 0}, {0, 0, 1e-12}}) z.generators.push_back(v);
  return z;
}

TEST(OrientedZonotope, HasTheLengthOfTheTextsProgramInRationals) {
  scenes::Random random(71);
  const int programs = std::getenv("DCH_TEST_LONG") != nullptr ? 12 : dch::effort(6);
  for (int n = 0; n < programs; ++n) {
    const std::size_t d = 2 + n % 3;
    const auto points = random_vectors(random, 5, d), directions = random_vectors(random, d + 1, d);
    const FittedZonotope found = oriented_zonotope(points, directions);
    const double least = least_total_length(points, found.directions);
    EXPECT_NEAR(found.total_length, least, 1e-7 * least) << d << " dimensions";
    EXPECT_GE(found.total_length, least * (1 - 1e-12)) << "it holds all points";
  }
}

TEST(OrientedZonotope, HoldsAllPoints) {
  scenes::Random random(72);
  for (int n = 0; n < 20; ++n) {
    const auto points = random_vectors(random, 100, 3);
    const FittedZonotope found = oriented_zonotope(points, random_vectors(random, 8, 3));
    const Zonotope larger = slightly_larger(in_space(found));
    for (const Coordinates& p : points) EXPECT_TRUE(contains(larger, {p[0], p[1], p[2]}));
    EXPECT_EQ(found.normals, 28);
    EXPECT_LE(found.rows, 56);
  }
}

TEST(OrientedZonotope, AlongTheAxesIsTheBoundingBox) {
  const FittedZonotope box =
      oriented_zonotope({{0, 0, 0}, {2, 1, 0}, {1, 4, 6}}, {{0, 0, 5}, {1, 0, 0}, {0, -2, 0}});
  EXPECT_NEAR(box.total_length, 1 + 2 + 3, 1e-9);
  EXPECT_NEAR(box.lengths[0], 3, 1e-9);
  EXPECT_NEAR(box.center[1], 2, 1e-9);
  EXPECT_EQ(in_plane(oriented_zonotope({{0, 0}, {2, 2}}, {{1, 1}, {1, 0}})).generators.size(), 1u);
  EXPECT_NEAR(oriented_zonotope({{3}, {5}, {4}}, {{-1}}).total_length, 1, 1e-9) << "one dimension";
}

TEST(OrientedZonotope, DirectionsMayBeFlatOrParallelOrNone) {
  const std::vector<Coordinates> plane{{1, 0, 1}, {0, 1, 1}, {1, 1, 2}, {2, 2, 4}};
  const FittedZonotope found = oriented_zonotope({{0, 0, 0}, {1, 2, 3}, {2, 1, 3}}, plane);
  EXPECT_GT(found.total_length, 0.5);
  EXPECT_NEAR(found.center[0] + found.center[1], found.center[2], 1e-12);
  EXPECT_EQ(oriented_zonotope({{1, 2}, {1, 2}}, {}).total_length, 0);
  EXPECT_EQ(oriented_zonotope({{1, 2}}, {{1, 0}}).center, (Coordinates{1, 2}));
}

TEST(OrientedZonotope, RefusesWhatCannotBe) {
  using ::testing::HasSubstr;
  const auto message = [](const std::vector<Coordinates>& points,
                          const std::vector<Coordinates>& directions) {
    return test::message_of<InvalidParameter>([&] { oriented_zonotope(points, directions); });
  };
  EXPECT_THAT(message({}, {}), HasSubstr("0 points"));
  EXPECT_THAT(message({{}}, {}), HasSubstr("0 coordinates"));
  EXPECT_THAT(message({{0, 0}, {1, 2}}, {{1, 0}}), HasSubstr("point 1 is 2 off the space"));
  EXPECT_THAT(message({{0, 0}, {1, 2}}, {}), HasSubstr("point 1"));
  EXPECT_THAT(message({{0, 0}}, {{0, 0}}), HasSubstr("direction 0 is 0"));
  EXPECT_THAT(message({{0, 0}}, {{1, 0, 0}}), HasSubstr("direction 0 has 3"));
  EXPECT_THAT(message({{0, NAN}}, {{1, 0}}), HasSubstr("point 0 has a coordinate of nan"));
  scenes::Random random(70);
  EXPECT_THAT(message({Coordinates(6, 0.0)}, random_vectors(random, 100, 6)), HasSubstr("normals"));
  EXPECT_THAT(test::message_of<InvalidParameter>([] {
                least_length_zonotope({{0, 0}}, 0);
              }),
              HasSubstr("epsilon = 0"));
  EXPECT_THROW(direction_grid(0, 1), InvalidParameter);
  EXPECT_THROW(in_space(oriented_zonotope({{1, 2}}, {})), InvalidParameter);
  EXPECT_THROW(in_plane(oriented_zonotope({{1, 2, 3}}, {})), InvalidParameter);
}

TEST(DirectionGrid, ComesNearEveryDirection) {
  scenes::Random random(73);
  for (const int d : {1, 2, 3, 4})
    for (const double distance : {1.0, 0.3}) {
      const auto grid = direction_grid(d, distance);
      for (int n = 0; n < 300; ++n) {
        Coordinates u(static_cast<std::size_t>(d));
        double square = 0;
        while (square == 0 || square > 1) {
          square = 0;
          for (double& x : u) x = random.uniform(-1, 1), square += x * x;
        }
        double least = INFINITY;
        for (const Coordinates& v : grid)
          for (const double sign : {1.0, -1.0}) {
            double sum = 0;
            for (std::size_t k = 0; k < u.size(); ++k)
              sum += std::pow(sign * u[k] / std::sqrt(square) - v[k], 2);
            least = std::min(least, sum);
          }
        EXPECT_LE(std::sqrt(least), distance);
      }
    }
  EXPECT_EQ(direction_grid(3, 0.5 / 3).size(), 243u);
}

TEST(LeastLengthZonotope, IsWithinEpsilonOfAZonotopeThatHoldsThePoints) {
  scenes::Random random(74);
  for (const std::size_t d : {2, 3})
    for (const double epsilon : {1.5, 1.0}) {
      // 78 directions in space take seconds.
      if (d == 3 && epsilon < 1.5 && std::getenv("DCH_TEST_LONG") == nullptr) continue;
      // The vertices of a zonotope: its own length is one that suffices.
      const auto generators = random_vectors(random, 5, d);
      double length = 0;
      for (const Coordinates& v : generators) {
        double square = 0;
        for (const double x : v) square += x * x;
        length += std::sqrt(square);
      }
      std::vector<Coordinates> points;
      for (unsigned signs = 0; signs < 32; ++signs) {
        points.emplace_back(d, 0.0);
        for (std::size_t k = 0; k < 5; ++k)
          for (std::size_t axis = 0; axis < d; ++axis)
            points.back()[axis] += (signs >> k & 1u ? 1 : -1) * generators[k][axis];
      }
      const FittedZonotope found = least_length_zonotope(points, epsilon);
      std::printf(
          "%zu dimensions, epsilon %g: %.4f of the zonotope's length, %zu directions, %ld rows, %d "
          "programs\n",
          d, epsilon, found.total_length / length, found.directions.size(), long(found.rows), found.programs);
      EXPECT_LE(found.total_length, (1 + epsilon) * length);
    }
}

}  // namespace
}  // namespace dch::zonotope
