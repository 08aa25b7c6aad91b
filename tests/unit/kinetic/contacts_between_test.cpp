// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/kinetic/contacts_between.hpp>

#include "error_message.hpp"

namespace dch::kinetic {
namespace {

using test::message_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const Box kCube = Box::orthorhombic({10, 10, 10});

PassingContacts between(double cutoff, const std::vector<Vec3>& before, const std::vector<Vec3>& after,
                        const Box& then = kCube, const Box& now = kCube) {
  return ContactsBetween(cutoff).find(before, then, after, now);
}

/// A point that flies past another, 0.6 to its side.
TEST(ContactsBetween, TellWhatNoFrameShows) {
  const auto found = between(1, {{3, 5, 5}, {5, 5.6, 5}}, {{7, 5, 5}, {5, 5.6, 5}});
  ASSERT_THAT(found.contacts, SizeIs(1));
  const PassingContact& contact = found.contacts[0];
  EXPECT_TRUE(contact.is_hidden());
  EXPECT_EQ(contact.i, 0);
  EXPECT_EQ(contact.j, 1);
  EXPECT_NEAR(contact.enters, 0.3, 1e-15);
  EXPECT_NEAR(contact.leaves, 0.7, 1e-15);
  EXPECT_NEAR(contact.closest, 0.6, 1e-15);
}

TEST(ContactsBetween, TellWhatComesAndWhatGoes) {
  const std::vector<Vec3> far{{3, 5, 5}, {5, 5, 5}}, near{{4.5, 5, 5}, {5, 5, 5}};
  const auto comes = between(1, far, near), goes = between(1, near, far);
  ASSERT_THAT(comes.contacts, SizeIs(1));
  EXPECT_TRUE(comes.contacts[0].is_shown_after && !comes.contacts[0].is_shown_before);
  EXPECT_NEAR(comes.contacts[0].enters, 2.0 / 3, 1e-15);
  EXPECT_EQ(comes.contacts[0].leaves, 1);
  EXPECT_NEAR(comes.contacts[0].closest, 0.5, 1e-15);
  ASSERT_THAT(goes.contacts, SizeIs(1));
  EXPECT_NEAR(goes.contacts[0].leaves, 1.0 / 3, 1e-15);
  EXPECT_THAT(between(1, near, near).contacts, IsEmpty()) << "it lasts";
}

/// What touches the cutoff and turns has no contact; frames show what is at the cutoff.
TEST(ContactsBetween, GrazingIsNoContact) {
  EXPECT_THAT(between(1, {{3, 5, 5}, {5, 6, 5}}, {{7, 5, 5}, {5, 6, 5}}).contacts, IsEmpty());
  const auto from = between(1, {{4, 5, 5}, {5, 5, 5}}, {{3, 5, 5}, {5, 5, 5}});
  ASSERT_THAT(from.contacts, SizeIs(1));
  EXPECT_TRUE(from.contacts[0].is_shown_before);
  EXPECT_EQ(from.contacts[0].leaves, 0);
}

/// One rounding error beyond the cutoff no frame shows a pair, and there is no contact where it parts.
TEST(ContactsBetween, WhatPartsBeyondTheCutoffHasNoContact) {
  const double beyond = std::nextafter(1.0, 2.0);
  EXPECT_THAT(between(1, {{0, 0, 0}, {beyond, 0, 0}}, {{0, 0, 0}, {2, 0, 0}}).contacts, IsEmpty());
  const auto nears = between(1, {{0, 0, 0}, {2, 0, 0}}, {{0, 0, 0}, {1, 0, 0}});
  ASSERT_THAT(nears.contacts, SizeIs(1));
  EXPECT_TRUE(nears.contacts[0].is_shown_after);
}

TEST(ContactsBetween, GoThroughFacesOfTheBox) {
  const auto found = between(1, {{9, 5, 5}, {1, 5.5, 5}}, {{2, 5, 5}, {11, 5.5, 5}});
  ASSERT_THAT(found.contacts, SizeIs(1));
  EXPECT_TRUE(found.contacts[0].is_hidden());
  EXPECT_NEAR(found.contacts[0].closest, 0.5, 1e-14);
}

/// A cutoff of half the box, and a point that meets one image of another, then the next one.
TEST(ContactsBetween, OfSeveralImages) {
  const auto found = between(4.5, {{0, 0, 0}, {4.8, 0, 0}}, {{2.4, 0, 0}, {2.6, 0, 0}});
  ASSERT_THAT(found.contacts, SizeIs(1));
  EXPECT_TRUE(found.contacts[0].is_shown_after);
  const auto two = between(5, {{0, 0, 0}, {3, 0, 0}}, {{3, 0, 0}, {-1, 0, 0}});  // 3 to -4: never beyond 5
  EXPECT_THAT(two.contacts, IsEmpty());
  const auto past = between(2, {{0, 0, 0}, {3, 0, 0}}, {{3.9, 0, 0}, {-0.9, 0, 0}});  // 3 to -4.8, and to 5.2
  ASSERT_THAT(past.contacts, SizeIs(1));
  EXPECT_TRUE(past.contacts[0].is_hidden());
}

TEST(ContactsBetween, LeavePointsOutThatMoveHalfABox) {
  const auto found = between(1, {{0, 0, 0}, {2, 0.5, 0}, {2, 0, 0.5}}, {{5, 0, 0}, {2, 0.5, 0}, {2, 5, 0.5}});
  EXPECT_THAT(found.undetermined_points, ElementsAre(0, 2));
  EXPECT_THAT(found.contacts, IsEmpty());
  const Box slab = Box::orthorhombic({10, 10, 10}, {true, true, false});
  const auto open = between(1, {{0, 0, 0}, {0.5, 0, 40}}, {{0, 0, 99}, {0.5, 0, 40}}, slab, slab);
  EXPECT_THAT(open.undetermined_points, IsEmpty());
  EXPECT_THAT(open.contacts, SizeIs(1)) << "along an open axis any way is known";
}

/// Points that only the box moves keep their distance in units of it.
TEST(ContactsBetween, FollowTheBox) {
  const Box wider = Box::orthorhombic({10.5, 10, 10});
  const auto found = between(1, {{0, 0, 0}, {0.98, 0, 0}, {9.9, 5, 5}},
                             {{0, 0, 0}, {1.029, 0, 0}, {-0.105, 5, 5}}, kCube, wider);
  EXPECT_THAT(found.undetermined_points, IsEmpty());
  ASSERT_THAT(found.contacts, SizeIs(1));
  EXPECT_NEAR(found.contacts[0].leaves, 0.02 / 0.049, 1e-12);
}

/// A box that turns is narrower halfway, where two images of a point are within the cutoff at once: that is
/// one contact.
TEST(ContactsBetween, ThroughTwoImagesAtOnceAreOne) {
  const double angle = 0.06, c = 10 * std::cos(angle), s = 10 * std::sin(angle);
  const Box turned = Box::triclinic({c, s, 0}, {-s, c, 0}, {0, 0, 10});
  const auto found =
      between(4.999, {{0, 0, 0}, {5, 0, 0}}, {{0, 0, 0}, {0.5 * c, 0.5 * s, 0}}, kCube, turned);
  EXPECT_EQ(found.undetermined, "");
  ASSERT_THAT(found.contacts, SizeIs(1));
  EXPECT_TRUE(found.contacts[0].is_hidden());
  EXPECT_NEAR(found.contacts[0].closest, 5 * std::cos(angle / 2), 1e-12);
}

/// A tilted cell that flips is the same lattice.
TEST(ContactsBetween, AFlipIsNoChange) {
  const Box then = Box::triclinic({10, 0, 0}, {4.99, 10, 0}, {0, 0, 10}),
            now = Box::triclinic({10, 0, 0}, {-4.98, 10, 0}, {0, 0, 10});
  const std::vector<Vec3> before{{3, 5, 5}, {5, 5.6, 5}}, after{{7, 5, 5}, {5, 5.6, 5}};
  const auto found = between(1, before, after, then, now);
  EXPECT_EQ(found.undetermined, "");
  ASSERT_THAT(found.contacts, SizeIs(1));
  EXPECT_TRUE(found.contacts[0].is_hidden());
}

TEST(ContactsBetween, SayWhatCannotBeFollowed) {
  const std::vector<Vec3> points{{1, 1, 1}, {2, 2, 2}};
  EXPECT_THAT(between(1, points, points, kCube, Box::orthorhombic({12, 10, 10})).undetermined,
              AllOf(HasSubstr("changes by 0.2"), HasSubstr("0.1")));
  EXPECT_THAT(
      between(1, points, points, kCube, Box::orthorhombic({10, 10, 10}, {true, true, false})).undetermined,
      AllOf(HasSubstr("orthorhombic ppp"), HasSubstr("orthorhombic ppf")));
  // The periods of the earlier lattice are in the later one, which has others between them.
  EXPECT_THAT(between(1, points, points, kCube, Box::orthorhombic({5, 10, 10})).undetermined,
              HasSubstr("repeats more often"));
}

TEST(ContactsBetween, OfNoPointsOneAndCoincidentOnes) {
  EXPECT_THAT(between(1, {}, {}).contacts, IsEmpty());
  EXPECT_THAT(between(1, {{1, 1, 1}}, {{2, 1, 1}}).contacts, IsEmpty());
  EXPECT_THAT(between(1, {{1, 1, 1}, {1, 1, 1}}, {{2, 1, 1}, {2, 1, 1}}).contacts, IsEmpty());
  EXPECT_THAT(between(1, {{1, 1, 1}, {1, 1, 1}}, {{2, 1, 1}, {3, 1, 1}}).contacts, IsEmpty());
}

TEST(ContactsBetween, RefuseWhatDoesNotFit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message_of<InvalidParameter>([] { ContactsBetween(-1.0); }), HasSubstr("cutoff = -1"));
  EXPECT_THAT(message_of<InvalidParameter>([&] { ContactsBetween between(nan); }), HasSubstr("cutoff = nan"));
  EXPECT_THAT(message_of<InvalidParameter>([] { ContactsBetween(1, "tree"); }), HasSubstr("tree"));
  EXPECT_THAT(message_of<InvalidParameter>([] {
                between(1, {{1, 1, 1}}, {});
              }),
              AllOf(HasSubstr("1 positions before"), HasSubstr("0 after")));
  EXPECT_THAT(message_of<InvalidPosition>([&] { between(1, {{1, 1, 1}}, {{nan, 1, 1}}); }), HasSubstr("nan"));
  EXPECT_THAT(message_of<CutoffTooLarge>([] { between(5.1, {{1, 1, 1}}, {{1, 1, 1}}); }), HasSubstr("5.1"));
  ContactsBetween again(1);
  const std::vector<Vec3> bad{{nan, 5, 5}, {5, 5.6, 5}}, before{{3, 5, 5}, {5, 5.6, 5}},
      after{{7, 5, 5}, {5, 5.6, 5}};
  EXPECT_THROW(again.find(before, kCube, bad, kCube), InvalidPosition);
  EXPECT_THAT(again.find(before, kCube, after, kCube).contacts, SizeIs(1))
      << "after an error all is as before";
}

}  // namespace
}  // namespace dch::kinetic
