// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/zonotope/membership.hpp>
#include <dch/zonotope/norm.hpp>
#include <dch/zonotope/zonotope_index.hpp>

#include "effort.hpp"
#include "random_zonotope.hpp"
#include "zonotope_scenes.hpp"

namespace dch::zonotope {
namespace {

TEST(ZonotopeIndexes, AnswerAsTheFunctionsDo) {
  scenes::Random random(91);
  std::int64_t queries = 0, searches = 0;
  for (int n = 0; n < effort(24); ++n) {
    const auto kind = static_cast<scenes::GeneratorKind>(n % 5);
    const Zonotope z = n % 2 == 0 ? random_zonotope(random, 3 + random.below(60))
                                  : Zonotope{{1, 2, 3}, scenes::grid_generators(random, kind, 12)};
    const auto size = static_cast<std::int64_t>(z.generators.size());
    for (const std::int64_t memory : {std::int64_t{0}, size, 4 * size, size * size}) {
      const ZonotopeIndex index(z, memory);
      for (int k = 0; k < 40; ++k) {
        const Vec3 x = random.in_cube(3);
        const double expected = norm(z, x);
        ASSERT_NEAR(index.norm(x), expected, 1e-9 * expected) << n << ", memory " << memory;
        const Vec3 near = z.center + 1 / expected * (1 + (k % 3 - 1) * 1e-13) * x;
        ASSERT_EQ(index.contains(near), contains(z, near));
      }
      queries += index.stats().queries;
      searches += index.stats().searches;
    }
  }
  std::printf("%ld of %ld answered without the index; half of the points are on the boundary\n",
              long(searches), long(queries));
  EXPECT_LT(searches, queries * 6 / 10);
}

TEST(ZonotopeIndexes, TradeMemoryForTime) {
  scenes::Random random(92);
  const std::size_t n = 1024;
  const Zonotope z = random_zonotope(random, n);
  std::vector<double> scaled;
  for (const std::int64_t share : {1, 4, 16, 64}) {
    const ZonotopeIndex index(z, share * static_cast<std::int64_t>(n));
    for (int k = 0; k < 100; ++k) index.norm(random.in_cube(1));
    const double operations = static_cast<double>(index.stats().operations) / 100;
    const double lg = std::log2(static_cast<double>(n));
    scaled.push_back(operations * static_cast<double>(share) / (static_cast<double>(n) * lg * lg));
    std::printf("m = %ld n: %.2f m entries, %.0f operations a query, %.2f n^2/m lg^2 n; %ld searches\n",
                long(share), static_cast<double>(index.entries()) / static_cast<double>(share * 1024),
                operations, scaled.back(), long(index.stats().searches));
    EXPECT_LT(index.entries(), 8 * share * static_cast<std::int64_t>(n));
    EXPECT_LT(index.stats().searches, 5);
  }
  EXPECT_LT(*std::max_element(scaled.begin(), scaled.end()), 4 * scaled[0]);
}

TEST(ZonotopeIndexes, RefuseWhatIsFlat) {
  EXPECT_THROW(ZonotopeIndex({{}, {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}, 100), InvalidParameter);
  EXPECT_THROW(ZonotopeIndex({{}, {{NAN, 0, 0}}}, 100), InvalidPosition);
  const ZonotopeIndex index({{}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 100);
  EXPECT_THROW(index.contains({NAN, 0, 0}), InvalidPosition);
  EXPECT_EQ(index.norm({0, 0, 0}), 0);
  EXPECT_TRUE(index.contains({1, 1, 1}));
  EXPECT_FALSE(index.contains({1, 1, 1 + 0x1p-52}));
}

}  // namespace
}  // namespace dch::zonotope
