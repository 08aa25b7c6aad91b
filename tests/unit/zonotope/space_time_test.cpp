// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <dch/base/error.hpp>
#include <dch/zonotope/membership.hpp>
#include <dch/zonotope/space_time.hpp>

#include "error_message.hpp"

namespace dch::zonotope {
namespace {

const Zonotope kCube{{}, {{0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}}};
constexpr double kPi = 3.14159265358979323846;

TEST(SpaceTime, ATranslationAddsHalfOfItself) {
  // With the whole vector for a generator the volume would be twice as long as the way.
  const Zonotope swept = swept_volume(kCube, {{4, 0, 0}, {}, {}, 0});
  EXPECT_EQ(swept.generators.size(), 4u);
  EXPECT_EQ(swept.center, (Vec3{2, 0, 0}));
  EXPECT_NEAR(support(swept, {1, 0, 0}), 4.5, 1e-12);
  EXPECT_NEAR(support(swept, {-1, 0, 0}), 0.5, 1e-12);
}

TEST(SpaceTime, ATurnAddsTwoGeneratorsAcrossItsAxis) {
  const Zonotope swept = swept_volume(kCube, {{}, {}, {0, 0, 3}, kPi / 3});
  ASSERT_EQ(swept.generators.size(), 5u);
  EXPECT_EQ(swept.center, kCube.center) << "no offset of the center";
  const double width = 2 * std::sqrt(0.5) * std::sin(kPi / 6);
  for (std::size_t k = 3; k < 5; ++k) {
    EXPECT_NEAR(std::sqrt(norm2(swept.generators[k])), width, 1e-13);
    EXPECT_NEAR(swept.generators[k].z, 0, 1e-16);
  }
}

TEST(SpaceTime, BodiesThatPassAtDifferentTimesDoNotMeet) {
  const Zonotope other{{2, -5, 0}, kCube.generators};
  const RigidMotion along_x{{10, 0, 0}, {}, {}, 0}, along_y{{0, 10, 0}, {}, {}, 0};
  EXPECT_TRUE(intersect(swept_volume(kCube, along_x), swept_volume(other, along_y))) << "paths cross";
  const FirstMeeting apart = first_meeting(kCube, along_x, other, along_y, 1e-6);
  EXPECT_EQ(apart.outcome, Meeting::none);
  EXPECT_GT(apart.intervals, 1);
  const Zonotope head_on{{6, 0, 0}, kCube.generators};
  const FirstMeeting contact = first_meeting(kCube, along_x, head_on, {}, 1e-6);
  EXPECT_EQ(contact.outcome, Meeting::contact);
  EXPECT_NEAR(contact.to, 0.5, 1e-6);
  EXPECT_LE(contact.from, 0.5);
  EXPECT_LT(contact.intervals, 60);
}

TEST(SpaceTime, AFlyingBodyThatEndsApartIsNotMissed) {
  const Zonotope wall{{5, 0, 0}, {{1e-3, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
  const RigidMotion through{{10, 0, 0}, {}, {}, 0};
  EXPECT_FALSE(intersect(placed(kCube, through, 0), wall));
  EXPECT_FALSE(intersect(placed(kCube, through, 1), wall));
  EXPECT_EQ(first_meeting(kCube, through, wall, {}, 1e-4).outcome, Meeting::contact);
}

TEST(SpaceTime, GrazingEndsWithinTheTolerance) {
  // The cube's corner turns to a distance of sqrt(1/2) and no farther: the wall stands there but for 1e-9.
  const RigidMotion turn{{}, {}, {0, 0, 1}, kPi / 2};
  for (const double gap : {1e-9, -1e-9}) {
    const Zonotope wall{{std::sqrt(0.5) + 1 + gap, 0, 0}, {{1, 0, 0}, {0, 3, 0}, {0, 0, 3}}};
    const FirstMeeting meeting = first_meeting(kCube, turn, wall, {}, 1e-6);
    EXPECT_NE(meeting.outcome, Meeting::none);
    EXPECT_NEAR(meeting.to, 0.5, 0.01) << gap;
    EXPECT_LT(meeting.intervals, 1000000);
  }
}

TEST(SpaceTime, RefusesWhatIsNoMotion) {
  EXPECT_THAT(test::message_of<InvalidParameter>([] {
                swept_volume(kCube, {{}, {}, {0, 0, 1}, kPi});
              }),
              ::testing::HasSubstr("180"));
  EXPECT_THAT(test::message_of<InvalidParameter>([] {
                swept_volume(kCube, {{}, {}, {}, 1});
              }),
              ::testing::HasSubstr("axis"));
  EXPECT_THROW(swept_volume(kCube, {}, 0.5, 0.25), InvalidParameter);
  EXPECT_THROW(swept_volume(kCube, {}, -0.5, 0.25), InvalidParameter);
  EXPECT_THROW(placed(kCube, {}, NAN), InvalidParameter);
  EXPECT_THROW(placed(kCube, {{}, {}, {0, 0, 1}, NAN}, 0), InvalidParameter);
  EXPECT_THROW(placed(kCube, {{NAN, 0, 0}, {}, {}, 0}, 0), InvalidPosition);
  EXPECT_THAT(test::message_of<InvalidParameter>([] { first_meeting(kCube, {}, kCube, {}, 0); }),
              ::testing::HasSubstr("tolerance of 0"));
}

}  // namespace
}  // namespace dch::zonotope
