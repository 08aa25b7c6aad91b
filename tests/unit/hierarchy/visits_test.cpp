// SPDX-License-Identifier: MIT
//
// What insertions and removals look at, nodes and blocks of points: as little however many points there are,
// and however many of them one leaf holds.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "hierarchy/structure.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

/// What is looked at to insert a point and to remove one, on average, among n points of density 1 in leaves
/// of about 150.
struct MeanVisits {
  double of_insertion, of_removal;
};
MeanVisits visits_among(std::size_t n) {
  const double side = std::cbrt(static_cast<double>(n));
  StructureParams params;
  params.radius = 1.5;
  ListedHierarchy h(params);
  h.build(scenes::uniform(n, {side, side, side}, 1), Box::none());
  const std::size_t inserted = 500, removed = std::min<std::size_t>(n / 2, 20'000);  // centers among them
  const auto visited_by = [&](const auto& work) {
    const std::int64_t before = h.stats().visited;
    work();
    return static_cast<double>(h.stats().visited - before);
  };
  MeanVisits visits;
  visits.of_insertion = visited_by([&] {
    for (const Vec3 p : scenes::uniform(inserted, {side, side, side}, 2)) h.insert(p);
  });
  visits.of_removal = visited_by([&] {
    for (std::size_t k = 0; k < removed; ++k) h.remove(static_cast<std::int32_t>(k * (n / removed)));
  });
  return {visits.of_insertion / static_cast<double>(inserted),
          visits.of_removal / static_cast<double>(removed)};
}

// O(lg alpha): ten times as many points add a constant. A descent that prunes nothing looks at all leaves,
// thousands among a million points.
TEST(Visits, OfInsertionAndRemovalGrowAsTheLogarithm) {
  MeanVisits before = visits_among(1000);
  EXPECT_LE(before.of_insertion, 28);
  EXPECT_LE(before.of_removal, 32);
  for (const std::size_t n : {10'000u, 100'000u, 1'000'000u}) {
    const MeanVisits visits = visits_among(n);
    EXPECT_LE(visits.of_insertion, before.of_insertion + 120) << n;
    EXPECT_LE(visits.of_removal, before.of_removal + 12) << n;
    before = visits;
  }
}

/// Points in a ball around the first one, which is their parent.
ListedHierarchy one_leaf_of(std::size_t n, double radius, double base_radius) {
  StructureParams params;
  params.radius = 1.5;
  params.base_radius = base_radius;
  ListedHierarchy h(params);
  h.build(std::vector<Vec3>{{}}, Box::none());
  scenes::Random random(6);
  while (h.size() < n) h.insert(random.in_ball(radius));
  return h;
}

// The chain of blocks of a leaf is as long as it has points; an insertion looks at a few of them.
TEST(Visits, InsertionIntoALargeLeafLooksAtAFewBlocks) {
  ListedHierarchy h = one_leaf_of(20'000, 0.4, 1);
  ASSERT_EQ(h.view().level(1).nodes, 1);
  EXPECT_LE(h.stats().visited, 20'000 * 20);
}

/// What an insertion into the leaf looks at.
std::int64_t visited_by_insertion(ListedHierarchy& h) {
  const std::int64_t before = h.stats().visited;
  h.insert({0.1, 0.1, 0.1});
  return h.stats().visited - before;
}

TEST(Visits, InsertionLooksAtSixteenBlocksFullOrNot) {
  ListedHierarchy short_chain = one_leaf_of(5, 0.4, 1), full_chain = one_leaf_of(320, 0.4, 1),
                  chain_with_room = one_leaf_of(315, 0.4, 1);
  const std::int64_t of_one_block = visited_by_insertion(short_chain);
  EXPECT_EQ(visited_by_insertion(full_chain), of_one_block + 15);
  EXPECT_EQ(visited_by_insertion(chain_with_room), of_one_block + 15);
}

// Twenty full blocks stand before twenty that have lost half of their points: the chain turns past them.
TEST(Visits, InsertionFillsBlocksBehindFullOnes) {
  ListedHierarchy h = one_leaf_of(320, 0.4, 1);
  ASSERT_EQ(h.view().structure().points.leaf.size(), 40u);
  for (std::int32_t id = 2; id < 160; id += 2) h.remove(id);
  for (int k = 0; k < 79; ++k) h.insert({0.1, 0.1, 0.1});
  EXPECT_LE(h.view().structure().points.leaf.size(), 42u);
  EXPECT_EQ(h.validate(), "");
}

// The center of a ball of points: its children look at the leaves near, those that come from among them too,
// and at nothing else.
TEST(Visits, RemovalOfACenterLooksAtAFewLeavesForEachChild) {
  for (const double radius : {0.4, 0.99}) {  // one leaf takes all others; many are promoted
    for (const std::size_t n : {1'000u, 100'000u}) {
      ListedHierarchy h = one_leaf_of(n, radius, 1);
      ASSERT_EQ(h.view().level(1).nodes, 1);
      const std::int64_t visited = h.stats().visited;
      h.remove(0);
      EXPECT_EQ(h.view().level(1).nodes > 4, radius > 0.5);
      EXPECT_LE(h.stats().visited - visited, static_cast<std::int64_t>(n) * (radius > 0.5 ? 26 : 2)) << n;
      if (n == 1'000u) {
        EXPECT_EQ(h.validate(), "");
      }
    }
  }
}

}  // namespace
}  // namespace dch
