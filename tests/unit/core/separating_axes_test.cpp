// SPDX-License-Identifier: MIT
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/geometry/separating_axes.hpp>

#include "effort.hpp"
#include "random.hpp"

namespace {

using dch::Vec3;
using dch::zonotope_is_apart;
using dch::scenes::Random;
using Exact = boost::multiprecision::cpp_rational;

/// Whether the origin is in the zonotope of three generators that span space: by its coordinates in their
/// basis.
bool holds_origin(Vec3 center, const std::vector<Vec3>& g) {
  const auto determinant = [](Vec3 a, Vec3 b, Vec3 c) {
    const auto e = [](double x) { return Exact(x); };
    return Exact(e(a.x) * (e(b.y) * e(c.z) - e(b.z) * e(c.y)) - e(a.y) * (e(b.x) * e(c.z) - e(b.z) * e(c.x)) +
                 e(a.z) * (e(b.x) * e(c.y) - e(b.y) * e(c.x)));
  };
  const Exact whole = abs(determinant(g[0], g[1], g[2]));
  return abs(determinant(center, g[1], g[2])) <= whole && abs(determinant(g[0], center, g[2])) <= whole &&
         abs(determinant(g[0], g[1], center)) <= whole;
}

TEST(SeparatingAxes, DecideParallelepipedsAsExactArithmeticDoes) {
  Random random(4);
  int apart = 0, count = dch::effort(4000);
  for (int k = 0; k < count; ++k) {
    const std::vector<Vec3> g{random.in_cube(1), random.in_cube(1), random.in_cube(1)};
    const Vec3 center = random.in_cube(1.2);
    const bool answer = zonotope_is_apart(center, g);
    ASSERT_EQ(answer, !holds_origin(center, g)) << k;
    apart += answer ? 1 : 0;
  }
  EXPECT_GT(apart, count / 10);
  EXPECT_LT(apart, count * 9 / 10);
}

/// Centers on a facet, moved by 1e-12 or by units of the last place: never apart where the origin is inside.
TEST(SeparatingAxes, NeverSeparateWhatMeets) {
  Random random(5);
  int decided = 0;
  for (int k = 0; k < dch::effort(2000); ++k) {
    std::vector<Vec3> g{random.in_cube(1), random.in_cube(1), random.in_cube(1)};
    if (k % 3 == 0) g[1] = g[0] + 1e-9 * g[1];  // nearly parallel
    const double s = random.uniform(-1, 1), t = random.uniform(-1, 1);
    const double by = k % 2 == 0 ? 1e-12 : 0;
    for (const double factor : {1 - by, 1 + by}) {
      const Vec3 center = s * g[0] + (t * g[1] + factor * g[2]);
      const bool answer = zonotope_is_apart(center, g);
      if (holds_origin(center, g)) {
        EXPECT_FALSE(answer) << k;
      } else if (by > 0 && k % 3 != 0) {
        decided += answer ? 1 : 0;
      }
    }
  }
  EXPECT_GT(decided, 100);
}

TEST(SeparatingAxes, OfFlatSetsSegmentsAndPoints) {
  const std::vector<Vec3> plane{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, segment{{1, 2, 3}, {-2, -4, -6}}, none;
  EXPECT_TRUE(zonotope_is_apart({0, 0, 1e-9}, plane));
  EXPECT_TRUE(zonotope_is_apart({2.001, 0, 0}, plane));
  EXPECT_FALSE(zonotope_is_apart({1.9, 0.5, 0}, plane));
  EXPECT_TRUE(zonotope_is_apart({2, -1.01, 0}, plane));
  EXPECT_FALSE(zonotope_is_apart({2.9, 5.8, 8.7}, segment));
  EXPECT_TRUE(zonotope_is_apart({3.1, 6.2, 9.3}, segment));
  EXPECT_TRUE(zonotope_is_apart({0.001, 0, 0}, segment));
  EXPECT_TRUE(zonotope_is_apart({0, 0, 1e-100}, none));
  EXPECT_FALSE(zonotope_is_apart({0, 0, 0}, none));
  EXPECT_FALSE(zonotope_is_apart({0, 0, 0}, std::vector<Vec3>(16)));
}

TEST(SeparatingAxes, AMarginIsADistance) {
  const std::vector<Vec3> box{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_TRUE(zonotope_is_apart({2, 0, 0}, box, 0.999));
  EXPECT_FALSE(zonotope_is_apart({2, 0, 0}, box, 1.001));
  EXPECT_FALSE(zonotope_is_apart({2, 2, 2}, box, 1.8));  // sqrt(3) from the corner
}

TEST(SeparatingAxes, RefusesBadInput) {
  EXPECT_THROW(zonotope_is_apart({}, std::vector<Vec3>(17)), dch::InvalidParameter);
  EXPECT_THROW(zonotope_is_apart({}, std::vector<Vec3>(2), -1), dch::InvalidParameter);
  EXPECT_THROW(zonotope_is_apart({}, std::vector<Vec3>(2), std::nan("")), dch::InvalidParameter);
}

}  // namespace
