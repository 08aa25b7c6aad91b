// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/zonotope/zonotope.hpp>

#include "error_message.hpp"
#include "random.hpp"
#include "random_zonotope.hpp"

namespace dch::zonotope {
namespace {

const Zonotope kCubeAt123{{1, 2, 3}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

TEST(ZonotopeTest, TheCubeHasItsVolumeAreaAndSupport) {
  EXPECT_EQ(volume(kCubeAt123), 8);
  EXPECT_EQ(surface_area(kCubeAt123), 24);
  EXPECT_EQ(support(kCubeAt123, {1, 0, 0}), 2);
  EXPECT_EQ(support(kCubeAt123, {-1, 2, 0}), -1 + 4 + 3);
  EXPECT_EQ(support_point(kCubeAt123, {1, -1, 0}), (Vec3{2, 1, 3}));
}

TEST(ZonotopeTest, TheTruncatedOctahedronHasSixGenerators) {
  // The permutations of (0, 1, 2) with all signs are its vertices; the edges are (+-1, +-1, 0) and so on.
  Zonotope z;
  for (const Vec3 v : {Vec3{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}})
    z.generators.push_back(0.5 * v);
  EXPECT_DOUBLE_EQ(volume(z), 32);  // 8 sqrt 2 a^3 with a = sqrt 2
  EXPECT_DOUBLE_EQ(support(z, {0, 0, 1}), 2);
  z.generators.pop_back();
  EXPECT_LT(volume(z), 32 - 1e-9);
}

TEST(ZonotopeTest, SupportOfSumsAndDifferencesAddsUp) {
  const Zonotope a = random_zonotope(5, 1), b = random_zonotope(4, 2);
  scenes::Random random(3);
  for (int k = 0; k < 100; ++k) {
    const Vec3 d = random.in_cube(1), minus{-d.x, -d.y, -d.z};
    EXPECT_NEAR(support(sum(a, b), d), support(a, d) + support(b, d), 1e-14);
    EXPECT_NEAR(support(difference(a, b), d), support(a, d) + support(b, minus), 1e-14);
    EXPECT_NEAR(dot(support_point(a, d), d), support(a, d), 1e-14);
  }
}

TEST(ZonotopeTest, ParallelAndZeroGeneratorsAreMerged) {
  Zonotope z = kCubeAt123;
  for (const Vec3 v : {Vec3{0, 0, 0}, {-0.5, 0, 0}, {3, 3, 0}, {-0.1, -0.1, 0}, {0.3, 0.3, 0}, {0, -0.0, 0}})
    z.generators.push_back(v);
  const Zonotope merged = canonical(z);
  ASSERT_EQ(merged.generators.size(), 4u);
  EXPECT_DOUBLE_EQ(volume(merged), volume(z));
  EXPECT_DOUBLE_EQ(surface_area(merged), surface_area(z));
  for (const Vec3 d : {Vec3{1, 2, 3}, {-1, 1, 0}, {0, 0, 1}})
    EXPECT_DOUBLE_EQ(support(merged, d), support(z, d));
  EXPECT_EQ(merged.generators[0], (Vec3{1.5, 0, 0}));
  EXPECT_EQ(merged.generators[3], (Vec3{0, 0, 1}));
}

TEST(ZonotopeTest, NearlyParallelGeneratorsStayApart) {
  const double up = std::nextafter(1.0, 2.0);
  EXPECT_EQ(canonical({{}, {{1, 1, 1}, {1, 1, up}}}).generators.size(), 2u);
  EXPECT_EQ(canonical({{}, {{0.1, 0.3, 0}, {0.1 * 3, 0.3 * 3, 0}}}).generators.size(), 2u)
      << "0.3 times 3 is rounded";
  EXPECT_EQ(canonical({{}, {{1e-160, 1e-160, 0}, {1e-160, 2e-160, 0}}}).generators.size(), 2u)
      << "their products underflow";
}

TEST(ZonotopeTest, TheCanonicalFormDoesNotDependOnTheOrder) {
  Zonotope z = random_zonotope(20, 7);
  for (std::size_t k = 0; k < 10; ++k) z.generators.push_back(-0.25 * z.generators[k]);
  const Zonotope once = canonical(z);
  scenes::Random random(8);
  random.shuffle(z.generators);
  EXPECT_EQ(canonical(z).generators, once.generators);
  EXPECT_EQ(canonical(once).generators, once.generators);
  EXPECT_EQ(once.generators.size(), 20u);
}

TEST(ZonotopeTest, WithoutGeneratorsItIsAPoint) {
  const Zonotope point{{1, 2, 3}, {}};
  EXPECT_EQ(volume(point), 0);
  EXPECT_EQ(surface_area(point), 0);
  EXPECT_EQ(support(point, {1, 1, 1}), 6);
  EXPECT_TRUE(canonical({{}, {{0, 0, 0}}}).generators.empty());
}

TEST(ZonotopeTest, RefusesWhatIsNotFinite) {
  Zonotope z = kCubeAt123;
  z.generators[1].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(test::message_of<InvalidPosition>([&] { volume(z); }),
              ::testing::HasSubstr("generator 1 = (0, nan, 0)"));
  z = kCubeAt123;
  z.center.x = -2e100;
  EXPECT_THAT(test::message_of<InvalidPosition>([&] { canonical(z); }),
              ::testing::HasSubstr("center = (-2e+100, 2, 3)"));
  EXPECT_THROW(surface_area(z), InvalidPosition);
}

}  // namespace
}  // namespace dch::zonotope
