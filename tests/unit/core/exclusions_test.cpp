// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/lists/exclusions.hpp>

namespace dch {
namespace {

std::vector<std::int32_t> partners(const Exclusions& exclusions, std::int32_t i) {
  const auto row = exclusions.partners(i);
  return {row.begin(), row.end()};
}

TEST(Exclusions, NoneByDefault) {
  const Exclusions none;
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.size(), 0u);
  EXPECT_FALSE(none.excluded(0, 1));
  EXPECT_TRUE(partners(none, 0).empty());
  EXPECT_TRUE(Exclusions::from_pairs(5, {}).empty());
}

TEST(Exclusions, PairsInAnyOrderAndRepeated) {
  const std::vector<IndexPair> pairs{{3, 1}, {1, 3}, {0, 3}, {3, 1}};
  const auto exclusions = Exclusions::from_pairs(4, pairs);
  EXPECT_EQ(exclusions.pairs(), 2);
  EXPECT_EQ(exclusions.size(), 4u);
  EXPECT_EQ(partners(exclusions, 3), (std::vector<std::int32_t>{0, 1}));
  EXPECT_TRUE(partners(exclusions, 2).empty());
  EXPECT_TRUE(exclusions.excluded(1, 3));
  EXPECT_TRUE(exclusions.excluded(3, 1));
  EXPECT_FALSE(exclusions.excluded(0, 1));
}

TEST(Exclusions, RowsAreTheSetsOfPartners) {
  std::mt19937 draw(20261126);
  for (int round = 0; round < 200; ++round) {
    const auto n = static_cast<std::int32_t>(2 + draw() % 30);
    const auto any = [&] { return static_cast<std::int32_t>(draw() % static_cast<unsigned>(n)); };
    std::vector<IndexPair> pairs;
    std::vector<std::set<std::int32_t>> expected(static_cast<std::size_t>(n));
    for (auto left = 1 + draw() % 60; left > 0; --left) {
      const std::int32_t i = any(), j = any();
      if (i == j) continue;
      pairs.push_back({i, j});
      expected[static_cast<std::size_t>(i)].insert(j);
      expected[static_cast<std::size_t>(j)].insert(i);
    }
    const auto exclusions = Exclusions::from_pairs(static_cast<std::size_t>(n), pairs);
    std::size_t entries = 0;
    for (std::int32_t i = 0; i < n; ++i) {
      const auto& row = expected[static_cast<std::size_t>(i)];
      EXPECT_EQ(partners(exclusions, i), std::vector<std::int32_t>(row.begin(), row.end()));
      entries += row.size();
    }
    EXPECT_EQ(2 * exclusions.pairs(), static_cast<std::int64_t>(entries));
  }
}

TEST(Exclusions, BondsOfABranchedChain) {
  // 0 - 1 - 2 - 3 - 4 with 5 on 2.
  const std::vector<IndexPair> bonds{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {2, 5}};
  const auto one = Exclusions::from_bonds(6, bonds, 1);
  EXPECT_EQ(one.pairs(), 5);
  EXPECT_EQ(partners(one, 2), (std::vector<std::int32_t>{1, 3, 5}));
  const auto two = Exclusions::from_bonds(6, bonds, 2);
  EXPECT_EQ(partners(two, 2), (std::vector<std::int32_t>{0, 1, 3, 4, 5}));
  EXPECT_EQ(partners(two, 0), (std::vector<std::int32_t>{1, 2}));
  const auto three = Exclusions::from_bonds(6, bonds, 3);
  EXPECT_EQ(partners(three, 0), (std::vector<std::int32_t>{1, 2, 3, 5}));
  EXPECT_EQ(partners(three, 4), (std::vector<std::int32_t>{1, 2, 3, 5}));
}

TEST(Exclusions, RingsDoNotExcludeAParticleFromItself) {
  const std::vector<IndexPair> triangle{{0, 1}, {1, 2}, {2, 0}};
  for (const int depth : {1, 2, 3}) {
    const auto exclusions = Exclusions::from_bonds(3, triangle, depth);
    EXPECT_EQ(exclusions.pairs(), 3) << depth;
    EXPECT_EQ(partners(exclusions, 1), (std::vector<std::int32_t>{0, 2})) << depth;
  }
}

TEST(Exclusions, BadIndicesAndDepthsAreRefused) {
  const auto pairs = [](IndexPair pair) { return std::vector<IndexPair>{{0, 1}, pair}; };
  EXPECT_THROW(Exclusions::from_pairs(3, pairs({0, 3})), InvalidParameter);
  EXPECT_THROW(Exclusions::from_pairs(3, pairs({-1, 2})), InvalidParameter);
  EXPECT_THROW(Exclusions::from_pairs(3, pairs({2, 2})), InvalidParameter);
  EXPECT_THROW(Exclusions::from_bonds(3, pairs({0, 3}), 1), InvalidParameter);
  EXPECT_THROW(Exclusions::from_bonds(3, pairs({0, 2}), 0), InvalidParameter);
  EXPECT_THROW(Exclusions::from_bonds(3, pairs({0, 2}), 4), InvalidParameter);
  try {
    Exclusions::from_bonds(3, pairs({7, 2}), 1);
    FAIL();
  } catch (const InvalidParameter& error) {
    EXPECT_STREQ(error.what(), "bond 1 (7, 2) names particle 7, but indices run from 0 to 2");
  }
}

}  // namespace
}  // namespace dch
