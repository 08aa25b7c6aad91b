// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <vector>

#include <dch/necklace/crossings.hpp>

#include "error_message.hpp"

namespace {

using dch::Box;
using dch::IndexPair;
using dch::InvalidParameter;
using dch::Vec3;
using dch::necklace::Chains;
using dch::necklace::CrossingFinder;
using dch::necklace::StepCrossings;
using dch::necklace::UndeterminedBond;
using dch::test::message_of;
using testing::HasSubstr;

const std::vector<IndexPair> kTwoBonds{{0, 1}, {2, 3}};

/// Two bonds across each other, the second at a height.
std::vector<Vec3> crossed(double height) {
  return {{-0.5, 0, 0}, {0.5, 0, 0}, {0, -0.5, height}, {0, 0.5, height}};
}

TEST(CrossingFinderLimits, ABeadThatMovesHalfTheBoxIsUndetermined) {
  const Box box = Box::orthorhombic({4, 4, 4});
  CrossingFinder finder(4, kTwoBonds);
  finder.start(crossed(1), box);
  std::vector<Vec3> to = crossed(-1);
  const StepCrossings& found = finder.step(to, box);
  EXPECT_TRUE(found.crossings.empty());
  ASSERT_EQ(found.undetermined.size(), 1U);
  EXPECT_EQ(found.undetermined[0].bond, 1);
  EXPECT_EQ(found.undetermined[0].reason, UndeterminedBond::Reason::bead_moved_too_far);
  // A little less is determined, and crosses.
  finder.start(crossed(1), box);
  EXPECT_EQ(finder.step(crossed(-0.99), box).crossings.size(), 1U);
  EXPECT_TRUE(finder.step(crossed(-1), box).undetermined.empty());
}

TEST(CrossingFinderLimits, ABondOfHalfTheBoxIsUndetermined) {
  const Box box = Box::orthorhombic({4, 4, 4});
  std::vector<Vec3> from = crossed(1);
  from[0].x = -1.5;
  for (const bool at_end : {false, true}) {
    CrossingFinder finder(4, kTwoBonds);
    finder.start(at_end ? crossed(1) : from, box);
    const StepCrossings& found = finder.step(at_end ? from : crossed(0.5), box);
    ASSERT_EQ(found.undetermined.size(), 1U);
    EXPECT_EQ(found.undetermined[0].bond, 0);
    EXPECT_EQ(found.undetermined[0].reason, UndeterminedBond::Reason::bond_too_long);
  }
}

/// Midpoints nearly as far apart as the sweeps' radii allow.
TEST(CrossingFinderLimits, CrossingsAtTheEndsOfBothBondsAreFound) {
  const auto placed = [](double height) {
    return std::vector<Vec3>{{-0.5, 0, 0}, {0.5, 0, 0}, {0.45, -0.01, height}, {1.4, 0.2, height}};
  };
  CrossingFinder finder(4, kTwoBonds);
  finder.start(placed(0.05), Box::none());
  EXPECT_EQ(finder.step(placed(-0.05), Box::none()).crossings.size(), 1U);
}

TEST(CrossingFinderLimits, WithoutABoxNothingIsTooFar) {
  CrossingFinder finder(4, kTwoBonds);
  finder.start(crossed(1e6), Box::none());
  EXPECT_EQ(finder.step(crossed(-1e6), Box::none()).crossings.size(), 1U);
}

TEST(CrossingFinderLimits, BondsThatAreMadeStartAnew) {
  const Box box = Box::orthorhombic({9, 9, 9});
  CrossingFinder finder(4, std::vector<IndexPair>{{0, 1}});
  finder.start(crossed(1), box);
  finder.set_bonds(std::vector<IndexPair>{{3, 2}, {1, 0}});
  const StepCrossings& first = finder.step(crossed(-1), box);
  EXPECT_TRUE(first.crossings.empty());
  EXPECT_EQ(first.started, 1);
  const StepCrossings& second = finder.step(crossed(1), box);
  EXPECT_EQ(second.crossings.size(), 1U);
  EXPECT_EQ(second.started, 0);
  finder.set_bonds(std::vector<IndexPair>{{2, 3}});
  EXPECT_TRUE(finder.step(crossed(-1), box).crossings.empty());
  // Two changes before one step: still new.
  finder.set_bonds(kTwoBonds);
  finder.set_bonds(std::vector<IndexPair>{{2, 3}, {0, 1}});
  EXPECT_EQ(finder.step(crossed(1), box).started, 1);
}

TEST(CrossingFinderLimits, BranchedBondsAreTestedWithoutASign) {
  // A star of beads 0 to 3 with its center at bead 0, and a bond.
  const std::vector<IndexPair> bonds{{0, 1}, {0, 2}, {0, 3}, {5, 4}};
  CrossingFinder finder(6, bonds);
  EXPECT_EQ(finder.bonds()[0], (IndexPair{4, 5}));
  const auto placed = [](double height) {
    return std::vector<Vec3>{{0, 0, 0},   {1, 0, 0},           {-1, 1, 0},
                             {-1, -1, 0}, {0.5, -0.5, height}, {0.5, 0.5, height}};
  };
  finder.start(placed(1), Box::none());
  const StepCrossings& found = finder.step(placed(-1), Box::none());
  ASSERT_EQ(found.crossings.size(), 1U);
  EXPECT_EQ(found.crossings[0].sign, 0);
  EXPECT_EQ(found.crossings[0].p, 0);
}

TEST(CrossingFinderLimits, NoBondsAndNoBeads) {
  CrossingFinder none(0, std::vector<IndexPair>{});
  none.start(std::vector<Vec3>{}, Box::none());
  EXPECT_EQ(none.step(std::vector<Vec3>{}, Box::none()).stats.bonds, 0);
  CrossingFinder one(2, std::vector<IndexPair>{{0, 1}});
  one.start(std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}}, Box::none());
  EXPECT_TRUE(one.step(std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}}, Box::none()).crossings.empty());
}

TEST(CrossingFinderLimits, RefusesBadInput) {
  using Bonds = std::vector<IndexPair>;
  EXPECT_THAT(message_of<InvalidParameter>([] { CrossingFinder(2, Bonds{{0, 2}}); }), HasSubstr("0 and 2"));
  EXPECT_THAT(message_of<InvalidParameter>([] {
                CrossingFinder(2, Bonds{{1, 1}});
              }),
              HasSubstr("with itself"));
  EXPECT_THAT(message_of<InvalidParameter>([] {
                CrossingFinder(2, Bonds{{0, 1}, {1, 0}});
              }),
              HasSubstr("twice"));
  dch::necklace::CrossingFinderParams params;
  params.thickness = -1;
  EXPECT_THAT(message_of<InvalidParameter>([&] {
                CrossingFinder(2, Bonds{{0, 1}}, params);
              }),
              HasSubstr("thickness is -1"));
  CrossingFinder finder(4, kTwoBonds);
  const Box box = Box::orthorhombic({9, 9, 9});
  EXPECT_THAT(message_of<InvalidParameter>([&] { finder.step(crossed(1), box); }), HasSubstr("start()"));
  EXPECT_THAT(message_of<InvalidParameter>([&] { finder.start(std::vector<Vec3>(3), box); }),
              HasSubstr("3 positions for 4 particles"));
  finder.start(crossed(1), box);
  EXPECT_THAT(message_of<InvalidParameter>([&] { finder.step(crossed(1), Box::none()); }),
              HasSubstr("periodic vectors"));
  finder.start(crossed(1), box);
  std::vector<Vec3> bad = crossed(1);
  bad[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(finder.step(bad, box), dch::InvalidPosition);
  EXPECT_THROW(finder.step(crossed(1), box), InvalidParameter);  // nothing is held after a throw
  EXPECT_THROW(finder.set_bonds(Chains(3)), InvalidParameter);
}

}  // namespace
