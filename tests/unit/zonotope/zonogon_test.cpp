// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/zonotope/zonogon.hpp>

#include "error_message.hpp"
#include "random.hpp"

namespace dch::zonotope {
namespace {

Vec2 in_square(scenes::Random& random, double half_side) {
  const double x = random.uniform(-half_side, half_side);
  return {x, random.uniform(-half_side, half_side)};
}

double polygon_area(const std::vector<Vec2>& corners) {
  double sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    sum += cross(corners[k] - corners[0], corners[(k + 1) % corners.size()] - corners[0]);
  return sum / 2;
}

TEST(ZonogonTest, TheSquareAndTheHexagonAreWhatTheyAre) {
  const Zonogon square{{1, 2}, {{1, 0}, {0, 1}}};
  EXPECT_EQ(area(square), 4);
  EXPECT_EQ(vertices(square), (std::vector<Vec2>{{0, 1}, {2, 1}, {2, 3}, {0, 3}}));
  EXPECT_EQ(support(square, {1, -1}), 0 + 1);
  EXPECT_EQ(support_point(square, {1, 0}), (Vec2{2, 2}));
  const Zonogon hexagon{{}, {{1, 0}, {0.5, std::sqrt(0.75)}, {-0.5, std::sqrt(0.75)}}};
  EXPECT_NEAR(area(hexagon), 6 * std::sqrt(3), 1e-14);
  EXPECT_EQ(vertices(hexagon).size(), 6u);
}

TEST(ZonogonTest, AreaIsThatOfAllPairsAndOfThePolygon) {
  scenes::Random random(3);
  for (int n = 0; n < 30; ++n) {
    Zonogon z{in_square(random, 1), {}};
    for (int k = 0; k < n; ++k) z.generators.push_back(in_square(random, 1));
    if (n > 4) z.generators.push_back(-0.5 * z.generators[1]);
    double pairs = 0;
    for (const Vec2 v : z.generators)
      for (const Vec2 w : z.generators) pairs += 2 * std::abs(cross(v, w));
    EXPECT_NEAR(area(z), pairs, 1e-13 * (1 + pairs));
    EXPECT_NEAR(polygon_area(vertices(z)), pairs, 1e-13 * (1 + pairs));
    EXPECT_EQ(vertices(z).size(), n == 0 ? 1u : 2u * n) << "parallel ones are merged";
    const Vec2 d = in_square(random, 1);
    EXPECT_NEAR(dot(support_point(z, d), d), support(z, d), 1e-13);
    EXPECT_NEAR(support(sum(z, z), d), 2 * support(z, d), 1e-13);
    EXPECT_NEAR(support(difference(z, z), d), support(z, d) + support(z, -1.0 * d), 1e-13);
  }
}

TEST(ZonogonTest, ContainsItsBoundaryAndNothingBeyond) {
  const Zonogon z{{0.5, 0.25}, {{1, 0}, {0, 1}, {1, 1}}};
  for (const Vec2 inside : {Vec2{2.5, 2.25}, {2.5, 1}, {-1.5, 0.25}, {0.5, 0.25}})
    EXPECT_TRUE(contains(z, inside));
  for (const Vec2 outside : {Vec2{2.5 + 0x1p-50, 1}, {-1.5 - 0x1p-51, 0.25}, {-0.5, 1.75}})
    EXPECT_FALSE(contains(z, outside));
  EXPECT_TRUE(intersect(z, {{4.5, 2.25}, {{2, 0}}}));
  EXPECT_FALSE(intersect(z, {{4.5 + 0x1p-50, 2.25}, {{2, 0}}}));
  EXPECT_TRUE(contains(Zonogon{{1, 1}, {}}, {1, 1}));
  EXPECT_FALSE(contains(Zonogon{{1, 1}, {{1, 0}}}, {1, 1 + 0x1p-52}));
}

TEST(MinAreaZonogon, OfATriangleIsTwiceAsLargeWhateverTheCenterInTheMedialTriangle) {
  // Against Lemma 3.4.3 and Corollary 3.4.4 the minimum is not unique.
  const std::vector<Vec2> triangle{{0, 0}, {4, 0}, {0, 4}};
  EXPECT_DOUBLE_EQ(area(min_area_zonogon(triangle)), 16);
  for (const Vec2 center : {Vec2{4.0 / 3, 4.0 / 3}, {1.5, 1}, {2, 2}, {0, 2}, {1.25, 1.75}})
    EXPECT_DOUBLE_EQ(area(enclosing_zonogon(triangle, center)), 16);
  for (const Vec2 center : {Vec2{2, 2.1}, {-0.1, 2}, {0, 0}})
    EXPECT_GT(area(enclosing_zonogon(triangle, center)), 16 + 1e-9);
}

TEST(MinAreaZonogon, OfASymmetricSetIsItsHull) {
  const std::vector<Vec2> square{{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0.1, 0.1}};
  const Zonogon z = min_area_zonogon(square);
  EXPECT_DOUBLE_EQ(area(z), 2);
  EXPECT_NEAR(z.center.x, 0, 1e-15);
  EXPECT_NEAR(z.center.y, 0, 1e-15);
}

TEST(MinAreaZonogon, OfFewPointsIsFlat) {
  EXPECT_TRUE(min_area_zonogon(std::vector<Vec2>{{1, 2}, {1, 2}}).generators.empty());
  const Zonogon segment = min_area_zonogon(std::vector<Vec2>{{1, 2}, {3, 4}, {2, 3}, {5, 6}});
  ASSERT_EQ(segment.generators.size(), 1u);
  EXPECT_EQ(segment.center, (Vec2{3, 4}));
  EXPECT_EQ(std::abs(segment.generators[0].x), 2);
}

TEST(MinAreaZonogon, RefusesNoPointsAndSuchThatAreNotFinite) {
  EXPECT_THAT(test::message_of<InvalidParameter>([] { min_area_zonogon(Span<const Vec2>{}); }),
              ::testing::HasSubstr("0 points"));
  const std::vector<Vec2> points{{0, 0}, {1, std::numeric_limits<double>::infinity()}};
  EXPECT_THAT(test::message_of<InvalidPosition>([&] { min_area_zonogon(points); }),
              ::testing::HasSubstr("point 1"));
  EXPECT_THROW(enclosing_zonogon(std::vector<Vec2>{{0, 0}}, {NAN, 0}), InvalidPosition);
  EXPECT_THROW(area({{NAN, 0}, {}}), InvalidPosition);
  EXPECT_THROW(contains(Zonogon{}, {NAN, 0}), InvalidPosition);
}

}  // namespace
}  // namespace dch::zonotope
