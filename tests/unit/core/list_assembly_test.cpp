// SPDX-License-Identifier: MIT
#include "lists/list_assembly.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <vector>

#include "list_compare.hpp"
#include "scenes.hpp"

namespace dch::detail {
namespace {

/// Rows by sorting, the obvious way.
NeighborList by_sorting(std::size_t n, ListKind kind, std::int32_t first_ghost, const PairBuffer& buffer) {
  std::vector<std::vector<std::int32_t>> rows(n);
  buffer([&](std::int32_t i, std::int32_t j) {
    rows[i].push_back(j);
    if (kind == ListKind::full && (first_ghost < 0 || j < first_ghost)) rows[j].push_back(i);
  });
  NeighborList list;
  list.kind = kind;
  for (auto& row : rows) {
    std::sort(row.begin(), row.end());
    list.j.insert(list.j.end(), row.begin(), row.end());
    list.first.push_back(static_cast<std::int64_t>(list.j.size()));
  }
  return list;
}

std::int64_t count_of(const PairBuffer& buffer) {
  std::int64_t count = 0;
  buffer([&](std::int32_t, std::int32_t) { ++count; });
  return count;
}

/// Distinct random pairs without two ghosts, in random order and sense.
PairBuffer random_pairs(std::size_t n, std::size_t count, std::int32_t first_ghost, scenes::Random& random) {
  std::set<IndexPair> chosen;
  for (std::size_t k = 0; k < count; ++k) {
    const auto i = static_cast<std::int32_t>(random.below(n)), j = static_cast<std::int32_t>(random.below(n));
    const bool ghosts = first_ghost >= 0 && std::min(i, j) >= first_ghost;
    if (i != j && !ghosts) chosen.insert({std::min(i, j), std::max(i, j)});
  }
  std::vector<IndexPair> order(chosen.begin(), chosen.end());
  random.shuffle(order);
  PairBuffer buffer;
  for (const auto& [i, j] : order) {
    if (random.uniform() < 0.5) {
      buffer.add(i, j);
    } else {
      buffer.add(j, i);
    }
  }
  return buffer;
}

TEST(ListAssembler, EqualsSortedRows) {
  scenes::Random random(1);
  ListAssembler assembler;  // used again and again, as engines do
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t n = 1 + random.below(60);
    const auto first_ghost = trial % 3 == 0 ? static_cast<std::int32_t>(random.below(n + 1)) : -1;
    const PairBuffer buffer = random_pairs(n, random.below(400), first_ghost, random);
    for (const ListKind kind : {ListKind::half, ListKind::full}) {
      NeighborList list;
      assembler.assemble(n, kind, first_ghost, buffer, list);
      ASSERT_EQ(malformation(list, n), "");
      ASSERT_EQ(first_difference(list, by_sorting(n, kind, first_ghost, buffer)), "");
      ASSERT_EQ(list.pairs(), count_of(buffer));
    }
  }
}

TEST(ListAssembler, EmptyInput) {
  ListAssembler assembler;
  PairBuffer buffer;
  NeighborList list;
  for (const ListKind kind : {ListKind::half, ListKind::full}) {
    for (const std::size_t n : {0u, 1u, 5u}) {
      assembler.assemble(n, kind, -1, buffer, list);
      EXPECT_EQ(malformation(list, n), "");
      EXPECT_EQ(list.pairs(), 0);
    }
  }
}

TEST(ListAssembler, OverwritesTheListItIsGiven) {
  ListAssembler assembler;
  PairBuffer buffer;
  buffer.add(4, 1);
  NeighborList list;
  assembler.assemble(5, ListKind::full, -1, buffer, list);
  assembler.assemble(6, ListKind::half, -1, buffer, list);
  EXPECT_EQ(list.kind, ListKind::half);
  EXPECT_EQ(list.first, (std::vector<std::int64_t>{0, 0, 1, 1, 1, 1, 1}));
  EXPECT_EQ(list.j, (std::vector<std::int32_t>{4}));
}

}  // namespace
}  // namespace dch::detail
