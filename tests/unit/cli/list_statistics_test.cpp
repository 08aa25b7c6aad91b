// SPDX-License-Identifier: MIT
#include "engines/list_statistics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dch::cli {
namespace {

using testing::ElementsAre;

/// Pairs 0-1, 0-2; atom 3 is alone.
NeighborList half_list() { return {ListKind::half, {0, 2, 2, 2, 2}, {1, 2}}; }
NeighborList full_list() { return {ListKind::full, {0, 2, 3, 4, 4}, {1, 2, 0, 0}}; }

TEST(ListStatistics, CountsNeighborsOfBothAtomsInHalfAndFullLists) {
  for (const NeighborList& list : {half_list(), full_list()}) {
    ListStatistics statistics;
    statistics.add(list, true);
    EXPECT_THAT(statistics.degree_histogram(), ElementsAre(1, 2, 1));
  }
}

TEST(ListStatistics, CountsAKeptListInEveryFrame) {
  ListStatistics statistics;
  statistics.add(half_list(), true);
  statistics.add(half_list(), false);
  EXPECT_THAT(statistics.degree_histogram(), ElementsAre(2, 4, 2));
}

TEST(ListStatistics, HashTellsListsApart) {
  ListStatistics a, b, c;
  a.add(half_list(), true);
  b.add(half_list(), true);
  EXPECT_EQ(a.hash(), b.hash());
  NeighborList other = half_list();
  other.j[1] = 3;
  c.add(other, true);
  EXPECT_NE(a.hash(), c.hash());
  b.add(half_list(), false);
  EXPECT_NE(a.hash(), b.hash());
}

}  // namespace
}  // namespace dch::cli
