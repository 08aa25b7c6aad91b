// SPDX-License-Identifier: MIT
#include "hierarchy/adjacency_rows.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "random.hpp"

namespace dch::detail {
namespace {

TEST(AdjacencyRows, HoldWhatArraysOfTheirOwnWould) {
  AdjacencyRows rows;
  std::vector<std::vector<std::int32_t>> expected(50);
  rows.resize(expected.size());
  scenes::Random random(1);
  for (std::int32_t step = 0; step < 20'000; ++step) {
    const auto k = static_cast<std::int32_t>(random.below(expected.size()));
    std::vector<std::int32_t>& row = expected[static_cast<std::size_t>(k)];
    if (random.below(40) == 0) {
      rows.clear_row(k);
      row.assign(random.below(60), step);
      rows.assign(k, row.data(), static_cast<std::int32_t>(row.size()));
    } else if (random.below(3) == 0 && !row.empty()) {
      const std::int32_t value = row[random.below(row.size())];
      rows.erase(k, value);
      *std::find(row.begin(), row.end(), value) = row.back();
      row.pop_back();
    } else {
      rows.push(k, step);
      row.push_back(step);
    }
    ASSERT_TRUE(std::equal(row.begin(), row.end(), rows.row(k).begin(), rows.row(k).end())) << step;
  }
  std::int64_t entries = 0;
  for (std::int32_t k = 0; k < 50; ++k) {
    const std::vector<std::int32_t>& row = expected[static_cast<std::size_t>(k)];
    ASSERT_TRUE(std::equal(row.begin(), row.end(), rows.row(k).begin(), rows.row(k).end())) << k;
    entries += static_cast<std::int64_t>(row.size());
  }
  EXPECT_EQ(rows.entries(), entries);
}

// Rows that come and go take the places of those that went: memory follows the rows there are.
TEST(AdjacencyRows, GiveTheirPlacesToOthers) {
  AdjacencyRows rows;
  rows.resize(100);
  scenes::Random random(2);
  const std::vector<std::int32_t> values(100);
  std::size_t early = 0;
  for (int round = 0; round < 20'000; ++round) {
    const auto k = static_cast<std::int32_t>(random.below(100));
    rows.clear_row(k);
    rows.assign(k, values.data(), static_cast<std::int32_t>(50 + random.below(50)));
    for (int more = 0; more < 3; ++more) rows.push(k, more);
    if (round == 2'000) early = rows.memory_bytes();
  }
  EXPECT_LE(early, 200'000u);
  EXPECT_LE(rows.memory_bytes(), 2 * early);
}

TEST(AdjacencyRows, AreFilledAnewInTheSameMemory) {
  AdjacencyRows rows;
  const std::vector<std::int32_t> values{3, 1, 2};
  const auto fill = [&] {
    rows.clear();
    rows.resize(200);
    for (std::int32_t k = 0; k < 200; ++k) rows.assign(k, values.data(), 3);
    return rows.memory_bytes();
  };
  const std::size_t before = fill();
  EXPECT_EQ(fill(), before);
  EXPECT_EQ(rows.entries(), 600);
}

}  // namespace
}  // namespace dch::detail
