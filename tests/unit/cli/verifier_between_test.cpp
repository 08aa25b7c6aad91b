// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "analysis/between_frames.hpp"
#include "engines/verifier.hpp"

namespace dch::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Atoms 11 and 12 that fly past each other; 13 and 14 stand far away.
class BetweenFramesTest : public testing::Test {
 protected:
  BetweenFramesTest() : between_(1, "dch", nullptr) {
    first_.box = second_.box = Box::orthorhombic({10, 10, 10});
    first_.ids = second_.ids = {11, 12, 13, 14};
    first_.positions = {{3, 5, 5}, {5, 5.6, 5}, {1, 1, 1}, {1, 4, 1}};
    second_.positions = {{7, 5, 5}, {5, 5.6, 5}, {1, 1, 1}, {1, 4, 1}};
  }

  /// Follows the atoms, and verifies what is made of the contacts.
  template <class Change>
  VerifyResult verify(const Change& change, VerifyMode mode = VerifyMode::all) {
    EXPECT_FALSE(between_.follow(first_, 2, none_));
    EXPECT_TRUE(between_.follow(second_, 5, none_));
    std::vector<BetweenContact> contacts = between_.contacts();
    change(contacts);
    Verifier::Interval interval = between_.subject();
    interval.contacts = contacts;
    const ListParams params;
    Verifier verifier(mode, params, 2);
    verifier.check_between(interval);
    return verifier.result();
  }

  trajectory::Frame first_, second_;
  Exclusions none_;
  BetweenFrames between_;
};

TEST_F(BetweenFramesTest, TellOfAtomsByTheirIds) {
  verify([](auto&) {});
  ASSERT_EQ(between_.contacts().size(), 1U);
  const BetweenContact& contact = between_.contacts()[0];
  EXPECT_TRUE(contact.is_hidden);
  EXPECT_EQ(contact.i, 11);
  EXPECT_EQ(contact.j, 12);
  EXPECT_EQ(between_.record().frame, 2);
  EXPECT_EQ(between_.record().next_frame, 5);
  EXPECT_EQ(between_.record().hidden, 1);
}

TEST_F(BetweenFramesTest, FollowAtomsThatBothFramesHold) {
  second_.ids = {9, 11, 12, 14};
  second_.positions = {{5, 5, 5}, {7, 5, 5}, {5, 5.6, 5}, {1, 4, 1}};
  verify([](auto&) {});
  EXPECT_EQ(between_.record().hidden, 1);
  EXPECT_EQ(between_.record().unmatched_atoms, 2);
}

TEST_F(BetweenFramesTest, LeaveExcludedPairsOut) {
  const std::vector<IndexPair> pairs{{0, 1}};
  none_ = Exclusions::from_pairs(4, pairs);
  EXPECT_EQ(verify([](auto&) {}).mismatches, 0);
  EXPECT_TRUE(between_.contacts().empty());
}

TEST_F(BetweenFramesTest, RightOnesAreVerified) {
  for (const VerifyMode mode : {VerifyMode::all, VerifyMode::sample}) {
    const VerifyResult result = verify([](auto&) {}, mode);
    EXPECT_EQ(result.mismatches, 0);
    EXPECT_THAT(result.intervals, ElementsAre(2));
    between_ = BetweenFrames(1, "dch", nullptr);
  }
  EXPECT_THAT(verify([](auto&) {}, VerifyMode::none).intervals, ElementsAre());
}

TEST_F(BetweenFramesTest, AMissingOneIsFound) {
  const VerifyResult result = verify([](auto& contacts) { contacts.clear(); });
  ASSERT_EQ(result.mismatches, 1);
  EXPECT_EQ(result.first[0].what, "hidden missing");
  EXPECT_THAT(result.first[0].message("nm"),
              HasSubstr("frames 2 to 5: a contact of atoms 11 and 12 that no frame shows"));
  EXPECT_THAT(result.first[0].message("nm"), HasSubstr("is missing"));
}

TEST_F(BetweenFramesTest, AnInventedOneIsFound) {
  const VerifyResult result = verify([](auto& contacts) {
    contacts.push_back({13, 14, 0.2, 0.3, 0.5, true});
  });
  ASSERT_EQ(result.mismatches, 1);
  EXPECT_EQ(result.first[0].what, "hidden extra");
  EXPECT_EQ(result.first[0].atom_a, 13);
  EXPECT_THAT(result.first[0].message("nm"), HasSubstr("is told of, but is none"));
}

TEST_F(BetweenFramesTest, WrongTimesAreFound) {
  EXPECT_EQ(verify([](auto& contacts) { contacts[0].enters += 1e-4; }).mismatches, 2);
}

}  // namespace
}  // namespace dch::cli
