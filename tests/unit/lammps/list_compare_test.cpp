// SPDX-License-Identifier: GPL-2.0-or-later
#include "list_compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

namespace dch::lammps {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(CompareEntries, OrderDoesNotMatter) {
  const ListDifference d =
      compare_entries({{0, 1, 0}, {2, 3, 1}, {0, 4, 0}}, {{2, 3, 1}, {0, 4, 0}, {0, 1, 0}});
  EXPECT_THAT(d.native_only, IsEmpty());
  EXPECT_THAT(d.dch_only, IsEmpty());
}

TEST(CompareEntries, FindsAMissingAndAnInventedPair) {
  const ListDifference d = compare_entries({{0, 1, 0}, {2, 3, 0}}, {{0, 1, 0}, {2, 5, 0}});
  EXPECT_THAT(d.native_only, ElementsAre(ListEntry{2, 3, 0}));
  EXPECT_THAT(d.dch_only, ElementsAre(ListEntry{2, 5, 0}));
}

TEST(CompareEntries, FindsWrongSpecialBits) {
  const ListDifference d = compare_entries({{0, 1, 2}}, {{0, 1, 0}});
  EXPECT_THAT(d.native_only, ElementsAre(ListEntry{0, 1, 2}));
  EXPECT_THAT(d.dch_only, ElementsAre(ListEntry{0, 1, 0}));
}

TEST(CompareEntries, FindsAPairThatStandsTwice) {
  const ListDifference d = compare_entries({{0, 1, 0}}, {{0, 1, 0}, {0, 1, 0}});
  EXPECT_THAT(d.native_only, IsEmpty());
  EXPECT_THAT(d.dch_only, ElementsAre(ListEntry{0, 1, 0}));
}

TEST(Unmatched, PairsSeenFromEitherSideCancel) {
  const double noise = 1e-15;
  EXPECT_THAT(unmatched({make_atom_pair(4, 9, {1, 2, 3}, 0, true),
                         make_atom_pair(9, 4, {-1 + noise, -2, -3}, 0, false)},
                        0.01),
              IsEmpty());
}

TEST(Unmatched, AnAtomAndItsImageSeenFromEitherSideCancel) {
  EXPECT_THAT(
      unmatched({make_atom_pair(4, 4, {0, -5, 5}, 0, true), make_atom_pair(4, 4, {1e-16, 5, -5}, 0, false)},
                0.01),
      IsEmpty());
}

TEST(Unmatched, ImagesOfOnePairAreDifferentPairs) {
  const auto left =
      unmatched({make_atom_pair(4, 9, {1, 2, 3}, 0, true), make_atom_pair(4, 9, {1, 2, -3}, 0, false)}, 0.01);
  ASSERT_EQ(left.size(), 2u);
  EXPECT_TRUE(left[0].native);
  EXPECT_FALSE(left[1].native);
}

TEST(Unmatched, SpecialBitsTellPairsApart) {
  EXPECT_EQ(
      unmatched({make_atom_pair(4, 9, {1, 2, 3}, 1, true), make_atom_pair(4, 9, {1, 2, 3}, 2, false)}, 0.01)
          .size(),
      2u);
}

TEST(Unmatched, EachPairCancelsOnlyOne) {
  const auto left =
      unmatched({make_atom_pair(4, 9, {1, 2, 3}, 0, true), make_atom_pair(4, 9, {1, 2, 3}, 0, true),
                 make_atom_pair(4, 9, {1, 2, 3}, 0, false), make_atom_pair(1, 9, {1, 2, 3}, 0, false)},
                0.01);
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left[0].low, 1);
  EXPECT_TRUE(left[1].native);
}

// The two builders agree on the side of every pair: then nothing may cancel but what is equal to the bit.
TEST(Unmatched, WithoutToleranceNothingCancels) {
  EXPECT_EQ(
      unmatched({make_atom_pair(4, 9, {1, 2, 3}, 0, true), make_atom_pair(4, 9, {1, 2, 3}, 0, false)}, -1)
          .size(),
      2u);
}

TEST(Describe, NamesAtomsDistanceBitsAndList) {
  EXPECT_EQ(describe(make_atom_pair(12, 5, {0, -3, 4}, 2, true)),
            "pair of atoms 5 and 12 at distance 5, special bits 2: in the native list only");
  EXPECT_EQ(describe(make_atom_pair(5, 12, {0, 3, 4}, 0, false)),
            "pair of atoms 5 and 12 at distance 5, special bits 0: in the DCH list only");
}

TEST(Unmatched, PairsAtTheirCutoffMayBeDropped) {
  std::vector<AtomPair> pairs{make_atom_pair(4, 9, {1, 2, 3}, 0, true),
                              make_atom_pair(5, 9, {1, 2, 3}, 0, false)};
  pairs[0].at_cutoff = true;
  drop_at_cutoff(pairs);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].low, 5);
}

}  // namespace
}  // namespace dch::lammps
