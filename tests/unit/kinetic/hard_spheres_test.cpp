// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/kinetic/sphere_growth.hpp>

#include "error_message.hpp"
#include "scenes.hpp"
#include "special_numbers.hpp"

namespace dch::kinetic {
namespace {

using test::message_of;
using testing::AllOf;
using testing::HasSubstr;

HardSphereParams with_radii(std::vector<double> radii, const Box& box = {}) {
  HardSphereParams params;
  params.box = box;
  params.radii = std::move(radii);
  return params;
}

std::vector<Collision> all_until(HardSpheres& spheres, double time) {
  std::vector<Collision> collisions;
  while (const auto collision = spheres.step(time)) collisions.push_back(*collision);
  return collisions;
}

TEST(HardSpheres, TwoThatMeetHeadOnExchangeTheirVelocities) {
  HardSpheres spheres(with_radii({1, 0.5}), std::vector<Vec3>{{0, 0, 0}, {5, 0, 0}},
                      std::vector<Vec3>{{1, 0, 0}, {-1, 0, 0}});
  const auto collisions = all_until(spheres, 10);
  ASSERT_EQ(collisions.size(), 1U);
  EXPECT_NEAR(collisions[0].time, 1.75, 1e-14);
  EXPECT_EQ(collisions[0].pair, (Edge{0, 1}));
  EXPECT_NEAR(collisions[0].impulse, 2, 1e-14);
  EXPECT_NEAR(spheres.virial(), 2 * 1.5, 1e-14);
  EXPECT_EQ(spheres.now(), 10);
  EXPECT_NEAR(spheres.velocity(0).x, -1, 1e-14);
  EXPECT_NEAR(spheres.position(1).x, 5 - 1.75 + 8.25, 1e-13);
  EXPECT_EQ(spheres.counters().collisions, 1);
}

TEST(HardSpheres, MassesAndRestitutionSayWhatACollisionLeaves) {
  HardSphereParams params = with_radii({0.5, 0.5});
  params.masses = {3, 1};
  params.restitution = 0.5;
  HardSpheres spheres(params, std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}}, std::vector<Vec3>{{1, 0, 0}, {}});
  EXPECT_EQ(all_until(spheres, 5).size(), 1U);
  // The center of mass keeps 3/4; of the relative velocity half is left.
  EXPECT_NEAR(spheres.velocity(0).x, 0.75 - 0.125, 1e-14);
  EXPECT_NEAR(spheres.velocity(1).x, 0.75 + 0.375, 1e-14);
  EXPECT_NEAR(spheres.momentum().x, 3, 1e-14);
}

/// A sphere that passes at exactly its distance touches nobody; one a little nearer does.
TEST(HardSpheres, ThoseThatGrazeFlyOn) {
  const auto meet = [](double off) {
    HardSpheres spheres(with_radii({0.5, 0.5}), std::vector<Vec3>{{0, 0, 0}, {4, off, 0}},
                        std::vector<Vec3>{{}, {-1, 0, 0}});
    return all_until(spheres, 10).size();
  };
  EXPECT_EQ(meet(1), 0U);
  EXPECT_EQ(meet(std::nextafter(1.0, 2.0)), 0U);
  EXPECT_EQ(meet(1 - 1e-12), 1U);
}

/// Two of a lattice that approach, in each of its pairs at the same time.
TEST(HardSpheres, CollisionsAtOneTimeComeInTheOrderOfIds) {
  std::vector<Vec3> positions, velocities;
  for (int k = 0; k < 40; ++k) {
    positions.push_back({2.0 * (k % 2), 4.0 * (k / 2), 0});
    velocities.push_back({k % 2 == 0 ? 1.0 : -1.0, 0, 0});
  }
  HardSpheres spheres(with_radii(std::vector<double>(40, 0.5)), positions, velocities);
  const auto collisions = all_until(spheres, 3);
  ASSERT_EQ(collisions.size(), 20U);
  for (std::int32_t k = 0; k < 20; ++k) {
    EXPECT_EQ(collisions[static_cast<std::size_t>(k)].time, 0.5);
    EXPECT_EQ(collisions[static_cast<std::size_t>(k)].pair, (Edge{2 * k, 2 * k + 1}));
  }
}

/// A row of spheres that touch hands a blow on to its end, all at one time.
TEST(HardSpheres, ARowThatTouchesHandsABlowOn) {
  std::vector<Vec3> positions, velocities(6);
  for (int k = 0; k < 6; ++k) positions.push_back({k == 0 ? -3.0 : k - 0.0, 0, 0});
  velocities[0] = {1, 0, 0};
  HardSpheres spheres(with_radii(std::vector<double>(6, 0.5)), positions, velocities);
  const auto collisions = all_until(spheres, 10);
  ASSERT_EQ(collisions.size(), 5U);
  for (const Collision& collision : collisions) EXPECT_NEAR(collision.time, 3, 1e-12);
  EXPECT_NEAR(spheres.velocity(5).x, 1, 1e-12);
  EXPECT_NEAR(spheres.energy(), 0.5, 1e-12);
}

TEST(HardSpheres, GrowingOnesPushEachOtherAway) {
  HardSpheres spheres(with_radii({0.5, 0.5}), std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}}, std::vector<Vec3>(2));
  spheres.set_growth(1);
  const auto first = spheres.step(5);
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->time, 1, 1e-14);
  EXPECT_NEAR(spheres.velocity(1).x, 1, 1e-14);
  EXPECT_NEAR(spheres.radius(0), 1, 1e-14);
  // They part at twice the speed at which their distance of contact grows, so they do not meet again.
  EXPECT_FALSE(spheres.step(50));
  EXPECT_GT(spheres.least_gap(), -1e-14);
}

TEST(HardSpheres, NoneAndOne) {
  HardSpheres none(with_radii({}), std::vector<Vec3>(), std::vector<Vec3>());
  EXPECT_FALSE(none.step(5));
  EXPECT_EQ(none.now(), 5);
  EXPECT_EQ(none.energy(), 0);
  EXPECT_EQ(none.least_gap(), kNever);
  HardSpheres one(with_radii({1}, Box::orthorhombic({10, 10, 10})), std::vector<Vec3>{{1, 2, 3}},
                  std::vector<Vec3>{{1, 0, 0}});
  one.advance_to(1002);
  EXPECT_LT(one.box().distance2(one.position(0), {3, 2, 3}), 1e-18);
}

/// In a wide and empty space its balls widen, so that it gets home in few steps.
TEST(HardSpheres, AFastOneFarFromAllOthersTakesFewSteps) {
  std::vector<Vec3> positions = scenes::uniform(50, {30, 30, 30}, 3), velocities(51);
  positions.push_back({-1e9, positions[7].y, positions[7].z});
  velocities[50] = {1e3, 0, 0};
  HardSpheres spheres(with_radii(std::vector<double>(51, 1e-3)), positions, velocities);
  const auto collision = spheres.step(2e6);
  ASSERT_TRUE(collision);
  EXPECT_EQ(collision->pair.b, 50);
  EXPECT_LT(spheres.counters().homes, 500);
}

TEST(HardSpheres, RefuseWhatDoesNotFit) {
  const std::vector<Vec3> two{{0, 0, 0}, {3, 0, 0}}, rest(2);
  const auto refused = [&](const HardSphereParams& params, const std::vector<Vec3>& at,
                           const std::vector<Vec3>& velocities) {
    return message_of<Error>([&] { HardSpheres(params, at, velocities); });
  };
  EXPECT_THAT(refused(with_radii({2, 1.5}), two, rest),
              AllOf(HasSubstr("spheres 0 and 1 overlap"), HasSubstr("are 3 apart"),
                    HasSubstr("add up to 3.5"), HasSubstr("smaller radii")));
  EXPECT_THAT(refused(with_radii({1}), two, rest), HasSubstr("1 radii for 2 spheres"));
  EXPECT_THAT(refused(with_radii({1, 0}), two, rest), HasSubstr("radius of sphere 1 = 0"));
  EXPECT_THAT(refused(with_radii({1, kNaN}), two, rest), HasSubstr("radius of sphere 1 = nan"));
  EXPECT_THAT(refused(with_radii({1, 1}), two, {{}}), HasSubstr("1 velocities for 2 spheres"));
  EXPECT_THAT(refused(with_radii({1, 1}), {{0, 0, 0}, {kNaN, 0, 0}}, rest),
              HasSubstr("position of sphere 1"));
  EXPECT_THAT(refused(with_radii({1, 1}), two, {{}, {0, kNaN, 0}}), HasSubstr("velocity of sphere 1"));
  HardSphereParams params = with_radii({1, 1});
  for (const double mass : {0.0, -1.0, kNaN}) {
    params.masses = {1, mass};
    EXPECT_THAT(refused(params, two, rest), HasSubstr("mass of sphere 1"));
  }
  params.masses = {1};
  EXPECT_THAT(refused(params, two, rest), HasSubstr("1 masses for 2 spheres"));
  params.masses = {};
  for (const double restitution : {0.0, 1.1, kNaN}) {
    params.restitution = restitution;
    EXPECT_THAT(refused(params, two, rest), AllOf(HasSubstr("restitution = "), HasSubstr("1 is elastic")));
  }
  EXPECT_THAT(refused(with_radii({2.5, 1}, Box::orthorhombic({10, 10, 10})), two, rest),
              AllOf(HasSubstr("diameter = 5"), HasSubstr("4.5"), HasSubstr("larger box")));
  EXPECT_THAT(message_of<Error>([&] {
                HardSpheres(with_radii({1, 1}), two, rest, kNaN);
              }),
              HasSubstr("start = nan"));
}

/// Each would have all others in its lists.
TEST(HardSpheres, RefuseManyOnOneSpotAtOnce) {
  const std::vector<Vec3> spot(50000);
  EXPECT_THAT(message_of<InvalidParameter>(
                  [&] { HardSpheres(with_radii(std::vector<double>(50000, 1)), spot, spot); }),
              HasSubstr("spheres 0 and 1 overlap"));
}

TEST(HardSpheres, RefuseTimeThatRunsBackAndChangeNothing) {
  HardSpheres spheres(with_radii({1}), std::vector<Vec3>(1), std::vector<Vec3>{{1, 0, 0}});
  spheres.advance_to(2);
  EXPECT_THAT(message_of<InvalidParameter>([&] { spheres.step(1); }),
              AllOf(HasSubstr("time = 1"), HasSubstr("before now, 2")));
  EXPECT_THAT(message_of<InvalidParameter>([&] { spheres.step(kNaN); }), HasSubstr("nan"));
  EXPECT_THAT(message_of<InvalidParameter>([&] { spheres.set_growth(-1); }), HasSubstr("growth = -1"));
  EXPECT_THAT(message_of<InvalidParameter>([&] { spheres.scale_velocities(0); }),
              HasSubstr("velocities = 0"));
  EXPECT_EQ(spheres.position(0), (Vec3{2, 0, 0}));
}

/// The middle one of three is hit from both sides, ever faster.
TEST(HardSpheres, SayWhereTheyCollapse) {
  HardSphereParams params = with_radii({0.5, 0.5, 0.5});
  params.restitution = 0.05;
  HardSpheres spheres(params, std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}},
                      std::vector<Vec3>{{1, 0, 0}, {}, {-1, 0, 0}});
  EXPECT_THAT(
      message_of<InvalidParameter>([&] { spheres.advance_to(100); }),
      AllOf(HasSubstr("collided 20 times"), HasSubstr("restitution of 0.05"), HasSubstr("nearer to 1")));
  EXPECT_THAT(message_of<InvalidParameter>([&] { spheres.advance_to(100); }), HasSubstr("broken off"));
}

TEST(HardSpheres, SayWhenTheyHaveGrownTooLargeForTheBox) {
  HardSpheres spheres(with_radii({1}, Box::orthorhombic({10, 10, 10})), std::vector<Vec3>(1),
                      std::vector<Vec3>(1));
  spheres.set_growth(1);
  EXPECT_THAT(message_of<CutoffTooLarge>([&] { spheres.advance_to(10); }),
              AllOf(HasSubstr("largest diameter"), HasSubstr("4.5"), HasSubstr("stop the growth")));
}

TEST(SphereGrowth, FillsTheShareThatIsAskedFor) {
  scenes::Random random(9);
  std::vector<Vec3> positions, velocities;
  for (int k = 0; k < 64; ++k) {
    positions.push_back({1.0 * (k % 4), 1.0 * (k / 4 % 4), 1.0 * (k / 16)});
    velocities.push_back(random.in_cube(1));
  }
  HardSpheres spheres(with_radii(std::vector<double>(64, 0.2), Box::orthorhombic({4, 4, 4})), positions,
                      velocities);
  const double energy = spheres.energy();
  const GrowthResult grown = grow(spheres, {0.5, 0.4, 1e6});
  EXPECT_FALSE(grown.is_jammed);
  EXPECT_NEAR(grown.fraction, 0.4, 1e-12);
  EXPECT_NEAR(spheres.volume() / 64, 0.4, 1e-12);
  EXPECT_NEAR(spheres.energy() / energy, 1, 1e-12);
  EXPECT_GT(grown.pressure, 2);
  EXPECT_GT(spheres.least_gap(), -1e-13);
  EXPECT_EQ(grow(spheres, {0.5, 0.3, 1e6}).fraction, spheres.volume() / 64);
}

TEST(SphereGrowth, RefusesWhatDoesNotFit) {
  const auto refused = [](const GrowthParams& params, const Box& box, Vec3 velocity) {
    HardSpheres spheres(with_radii({0.5}, box), std::vector<Vec3>(1), std::vector<Vec3>{velocity});
    return message_of<InvalidParameter>([&] { grow(spheres, params); });
  };
  const Box cube = Box::orthorhombic({4, 4, 4});
  const Vec3 fast{1, 0, 0};
  EXPECT_THAT(refused({0, 0.3, 10}, cube, fast), HasSubstr("rate of growth = 0"));
  EXPECT_THAT(refused({kNaN, 0.3, 10}, cube, fast), HasSubstr("rate of growth = nan"));
  EXPECT_THAT(refused({1, 1.1, 10}, cube, fast), HasSubstr("fraction = 1.1"));
  EXPECT_THAT(refused({1, 0.3, 1}, cube, fast), HasSubstr("most_pressure = 1"));
  EXPECT_THAT(refused({1, 0.3, 10}, {}, fast), HasSubstr("periodic"));
  EXPECT_THAT(refused({1, 0.3, 10}, cube, {}), HasSubstr("energy of the spheres is 0"));
}

}  // namespace
}  // namespace dch::kinetic
