// SPDX-License-Identifier: MIT
//
// Counts at the end of what 32-bit indices name, without things of that number.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/base/index_count.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/lists/pair_list.hpp>
#include <dch/necklace/chains.hpp>
#include <dch/necklace/shapes.hpp>

#include "error_message.hpp"
#include "grid/cell_grid.hpp"
#include "hierarchy/build/block_order.hpp"
#include "hierarchy/leaf_blocks.hpp"

namespace dch {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();

TEST(IndexCount, EndsAtTheLargestIndexOrAtTheLimitGiven) {
  EXPECT_EQ(index_count(0, "points", ""), 0);
  EXPECT_EQ(index_count(kMax, "points", ""), kMax);
  EXPECT_EQ(index_count(7, "points", "", 7), 7);
  EXPECT_THAT(
      test::message_of<InvalidParameter>([] { index_count(2147483648, "points", "take fewer"); }),
      AllOf(HasSubstr("2147483648 points"), HasSubstr("at most 2147483647"), HasSubstr("take fewer")));
  EXPECT_THROW(index_count(8, "points", "", 7), InvalidParameter);
}

// The last lane of the last block has a slot that an index names, and so has the number of slots.
TEST(LeafBlocks, SlotsStayBelowTheLargestIndex) {
  constexpr std::int64_t most = detail::kMaxBlocks;
  EXPECT_EQ(most, (std::int64_t{1} << 28) - 1);
  EXPECT_LE(most * detail::kBlock, kMax);
  EXPECT_EQ(detail::block_count(most), most);
  EXPECT_THAT(
      test::message_of<InvalidParameter>([] { detail::block_count(most + 1); }),
      AllOf(HasSubstr("268435456 blocks"), HasSubstr("at most 268435455"), HasSubstr("take fewer points")));
}

TEST(LeafBlocks, NumberOfBlocksOfAnyNumberOfPoints) {
  for (const std::int32_t points : {0, 1, 7, 8, 9, 16, kMax - 8, kMax - 7, kMax})
    EXPECT_EQ(detail::blocks_for(points), (std::int64_t{points} + 7) / 8) << points;
}

TEST(CellNumbering, DenseBlocksStayBelowTheLargestIndex) {
  const auto fits = &detail::CellNumbering::fits_dense_block;
  EXPECT_TRUE(fits(1000, {0, 0, 0}, {9, 9, 39}));
  EXPECT_FALSE(fits(1000, {0, 0, 0}, {9, 9, 40})) << "memory goes by the number of points";
  EXPECT_TRUE(fits(kMax, {0, 0, 0}, {kMax - 1, 0, 0}));
  EXPECT_FALSE(fits(kMax, {0, 0, 0}, {1023, 1023, 2047})) << "2^31 cells for 2^31 - 1 points";
  EXPECT_FALSE(fits(kMax, {-(1 << 30), -(1 << 30), -(1 << 30)}, {1 << 30, 1 << 30, 1 << 30}));
}

TEST(Chains, RefuseMoreParticlesThanIndices) {
  constexpr std::size_t too_many = std::size_t{1} << 31;
  EXPECT_THAT(test::message_of<InvalidParameter>([] { necklace::Chains{too_many}; }),
              HasSubstr("2147483648 particles"));
  EXPECT_THROW(necklace::Chains::from_bonds(too_many, {}), InvalidParameter);
}

TEST(Shapes, RefuseMoreBeadsThanIndices) {
  EXPECT_THROW(necklace::torus_knot(2, 3, 100'000'000), InvalidParameter);
  EXPECT_THROW(necklace::torus_knot(kMax, kMax - 1, 100), InvalidParameter);
  EXPECT_THROW(necklace::facing_bumps(kMax, kMax, 0.5, 0), InvalidParameter);
}

TEST(PairList, ImagesAndTypesBeyondIndicesAreRefused) {
  const Box box = Box::orthorhombic({10, 10, 10});
  NeighborList list;
  list.first = {0, 1, 1};
  list.j = {1};
  const auto make = [&](double periods, std::int32_t type) {
    const std::vector<Vec3> points{{0, 0, 0}, {10 * periods + 1, 0, 0}};
    const std::vector<std::int32_t> types{0, type};
    PairList pairs;
    make_pair_list(
        list, 2, points, box, types, [](std::int32_t, std::int32_t) { return true; }, pairs);
    return pairs;
  };
  EXPECT_EQ(make(2e9, 0).groups[1].image[0], -2000000000);
  EXPECT_EQ(make(-2e9, 0).groups[1].image[0], 2000000000);
  for (const double periods : {2.2e9, -2.2e9}) {
    EXPECT_THAT(test::message_of<InvalidPosition>([&] { make(periods, 0); }),
                AllOf(HasSubstr("2.2e+09"), HasSubstr("2147483647"), HasSubstr("wrap")));
  }
  EXPECT_EQ(make(0, kMax - 1).types, kMax);
  EXPECT_THROW(make(0, kMax), InvalidParameter);
}

}  // namespace
}  // namespace dch
