// SPDX-License-Identifier: MIT
//
// Kept lists against all pairs: a list that is kept lacks no pair within its cutoff, and one that is given up
// because of a pair lacks a pair. Engines that can tell all say the same.
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/engines/verlet_list.hpp>

#include "effort.hpp"
#include "kept_lists.hpp"
#include "scenes.hpp"

namespace dch::expiry {
namespace {

/// A vector of the lattice, some periods long.
Vec3 periods(const Box& box, scenes::Random& random) {
  Vec3 shift;
  for (int axis = 0; axis < 3; ++axis)
    if (box.periodic(axis)) shift = shift + std::nearbyint(random.uniform(-3, 3)) * box.vector(axis);
  return shift;
}

class ListExpiry : public ::testing::TestWithParam<scenes::NamedBox> {};

// Most particles hardly move, few fly, and any of them may be given in another image than before.
TEST_P(ListExpiry, IsWhenAPairIsMissing) {
  constexpr std::size_t kPoints = 160;
  const Requests requests(kPoints);
  int kept = 0, given_up = 0;
  for (const NamedRequest& request : requests.all()) {
    scenes::Random random(11);
    Follower follower(GetParam().box, request, scenes::uniform_in(GetParam().box, kPoints, 5));
    std::vector<Vec3> points = follower.points(), velocity(kPoints);
    for (std::size_t i = 0; i < kPoints; ++i) velocity[i] = random.in_ball(i % 12 == 0 ? 0.05 : 0.006);
    for (int step = 0; step < effort(60); ++step) {
      for (std::size_t i = 0; i < kPoints; ++i) {
        points[i] = points[i] + velocity[i] + random.in_ball(0.004);
        if (random.below(20) == 0) points[i] = points[i] + periods(follower.box(), random);
      }
      follower.step_to(points, "step " + std::to_string(step));
      if (HasFatalFailure()) return;
    }
    kept += follower.kept_beyond_half();
    given_up += follower.given_up_for_a_pair();
  }
  EXPECT_GT(kept, effort(200)) << "the test says little if lists are never kept beyond half the skin";
  EXPECT_GT(given_up, effort(20)) << "nor if no pair is ever missing";
}

// One particle at a time is anywhere all of a sudden.
TEST_P(ListExpiry, SeesParticlesThatJump) {
  constexpr std::size_t kPoints = 120;
  const Requests requests(kPoints);
  for (const NamedRequest& request : requests.all()) {
    scenes::Random random(12);
    Follower follower(GetParam().box, request, scenes::uniform_in(GetParam().box, kPoints, 6));
    for (int step = 0; step < effort(30); ++step) {
      std::vector<Vec3> points = follower.points();
      for (Vec3& p : points) p = p + random.in_ball(0.01);
      Vec3& p = points[random.below(kPoints)];
      p = p + random.in_ball(std::pow(10, random.uniform(-1, 1.5)));
      follower.step_to(points, "step " + std::to_string(step));
      if (HasFatalFailure()) return;
    }
  }
}

// Two particles that meet, each by its share of the way, amid others that stand still: from just beyond the
// list to just within the cutoff or just without.
void expect_to_see_pairs_that_meet(const Box& box, Vec3 far, double least, scenes::Random& random) {
  const Requests requests(2);
  const NamedRequest& request = requests.all()[0];
  for (const double share : {0.0, 0.2, 0.45, 0.5, 0.5, 0.5, 0.55, 0.8, 1.0}) {
    for (const double aside : {0.0, 0.5, 2.0}) {  // of the skin, at right angles
      for (const double off : {-least, least}) {
        const Vec3 p =
            far + scenes::from_fractional(box, {random.uniform(), random.uniform(), random.uniform()});
        const Vec3 any = random.in_ball(1), along = (1 / std::sqrt(norm2(any))) * any;
        const Vec3 across = cross(along, Vec3{along.z, along.x, along.y} + Vec3{0.1, 0.2, 0.3});
        const Vec3 sideways = aside * kSkin / std::sqrt(norm2(across)) * across;
        const std::vector<Vec3> before{p, p + (kRadius + least) * along};
        const double way = kRadius + least - kCutoff - off;
        const std::vector<Vec3> after{before[0] + share * way * along + sideways + periods(box, random),
                                      before[1] - (1 - share) * way * along + sideways};
        Follower follower(box, request, before);
        follower.step_to(after, "share " + std::to_string(share) + ", " + std::to_string(off));
        if (::testing::Test::HasFatalFailure()) return;
        ASSERT_EQ(follower.given_up_for_a_pair() > 0, off < 0) << share;
      }
    }
  }
}

TEST_P(ListExpiry, SeesPairsThatMeetAtTheLastMoment) {
  const Box& box = GetParam().box;
  scenes::Random random(13);
  expect_to_see_pairs_that_meet(box, {}, 1e-7, random);
  if (box.any_periodic()) return;
  // Without a box, distances of places that are given are exact, however far they are from the origin.
  for (int trial = 0; trial < 20; ++trial)
    expect_to_see_pairs_that_meet(box, {1e12, -1e12, 1e12}, 5e-4, random);
}

// Squares of such lengths are beyond the range of single precision.
TEST_P(ListExpiry, HoldsInAnyUnitOfLength) {
  constexpr std::size_t kPoints = 100;
  const Requests requests(kPoints);
  for (const double unit : {1e-25, 1e-13, 1e13, 1e25}) {
    NamedRequest request = requests.all()[0];
    request.name = "a length of " + std::to_string(std::log10(unit)) + " decades";
    request.params.cutoffs = TypeCutoffs(kCutoff * unit);
    request.params.skin = kSkin * unit;
    const Box& small = GetParam().box;
    const Box box =
        small.kind() == Box::Kind::none
            ? small
            : Box::triclinic(unit * small.vector(0), unit * small.vector(1), unit * small.vector(2),
                             {small.periodic(0), small.periodic(1), small.periodic(2)});
    scenes::Random random(16);
    std::vector<Vec3> points = scenes::uniform_in(box, kPoints, 17);
    if (box.kind() == Box::Kind::none)
      for (Vec3& p : points) p = unit * p;
    Follower follower(box, request, points);
    for (int step = 0; step < effort(24); ++step) {
      for (std::size_t i = 0; i < kPoints; ++i)
        points[i] = points[i] + random.in_ball((i % 10 == 0 ? 0.1 : 0.01) * unit);
      follower.step_to(points, "step " + std::to_string(step));
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(follower.given_up_for_a_pair() + follower.kept_beyond_half(), 0);
  }
}

// Coordinates are so large that they round: without a box, where distances are exact all the same, by a
// thousandth of the skin.
TEST_P(ListExpiry, HoldsFarFromTheOrigin) {
  constexpr std::size_t kPoints = 120;
  const Requests requests(kPoints);
  const Box& near = GetParam().box;
  const double far = near.kind() == Box::Kind::none ? 2e12 : 1e9;
  const Vec3 shift{far, -far, far};
  const Box box = near.kind() == Box::Kind::none
                      ? near
                      : Box::triclinic(near.vector(0), near.vector(1), near.vector(2),
                                       {near.periodic(0), near.periodic(1), near.periodic(2)}, shift);
  scenes::Random random(18);
  std::vector<Vec3> points = scenes::uniform_in(box, kPoints, 19);
  if (box.kind() == Box::Kind::none)
    for (Vec3& p : points) p = p + shift;
  Follower follower(box, requests.all()[0], points);
  for (int step = 0; step < effort(60); ++step) {
    for (std::size_t i = 0; i < kPoints; ++i)
      points[i] = points[i] + random.in_ball(i % 10 == 0 ? 0.1 : 0.01);
    follower.step_to(points, "step " + std::to_string(step));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(follower.given_up_for_a_pair() + follower.kept_beyond_half(), 0);
}

// Points on their own, blocks of nothing, deep trees: wide boxes, in which repairs are put off for long.
TEST_P(ListExpiry, SeesParticlesOfThinScenes) {
  constexpr std::size_t kPoints = 250;
  Box box = GetParam().box;
  const Requests requests(kPoints);
  const double wide = 12;
  const Box::Periodic periodic{box.periodic(0), box.periodic(1), box.periodic(2)};
  if (box.kind() != Box::Kind::none)
    box = Box::triclinic(wide * box.vector(0), wide * box.vector(1), wide * box.vector(2), periodic,
                         box.origin());
  scenes::Random random(14);
  std::vector<Vec3> points = scenes::clustered(box, kPoints, 15);
  if (box.kind() == Box::Kind::none)
    for (Vec3& p : points) p = wide * p;
  Follower follower(box, requests.all()[0], points);
  for (int step = 0; step < effort(80); ++step) {
    for (std::size_t i = 0; i < kPoints; ++i)
      points[i] = points[i] + random.in_ball(i % 40 == 0 ? 0.3 : 0.01);
    if (step % 4 == 0) {  // one goes to another's neighborhood
      const Vec3 other = points[random.below(kPoints)];
      points[random.below(kPoints)] = other + random.in_ball(1.2 * kRadius);
    }
    follower.step_to(points, "step " + std::to_string(step));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(follower.given_up_for_a_pair(), 0);
}

// Where coordinates wrap modulo 2^16, a way of any length may look like none.
TEST(ListExpiryOfFewParticles, SeesOneThatComesFromAfar) {
  const Requests requests(3);
  for (const Box& box : {Box::none(), Box::orthorhombic({120, 120, 120})}) {
    for (int k = 0; k < effort(80); ++k) {
      const Vec3 there{5 + 0.5 * k, 0, 0};
      Follower follower(box, requests.all()[0], {{1, 1, 1}, Vec3{1, 1, 1} + there, {1, 1, 9}});
      follower.step_to({Vec3{1, 1.9, 1} + there, Vec3{1, 1, 1} + there, {1, 1, 9}}, std::to_string(there.x));
      if (HasFatalFailure()) return;
      ASSERT_GT(follower.given_up_for_a_pair(), 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, ListExpiry, ::testing::ValuesIn(scenes::all_boxes(5)),
                         [](const auto& test) { return test.param.name; });

// Where engines cannot tell, or the box is another one, half the skin decides as ever.
TEST(ListExpiryRules, HalfTheSkinDecidesWhereNobodyCanTell) {
  const Requests requests(2);
  const ListParams& params = requests.all()[0].params;
  const Box box = Box::orthorhombic({6, 6, 6}), wider = Box::orthorhombic({6 + 1e-9, 6, 6});
  const std::vector<Vec3> points{{1, 1, 1}, {4, 4, 4}}, far{{1.16, 1, 1}, {4, 4, 4}};
  for (const bool exact : {true, false}) {
    VerletList list(make_dch_search(kRadius), params, exact ? Expiry::exact : Expiry::half_skin);
    list.update(points, box);
    EXPECT_EQ(list.is_stale(far, box), !exact);
    EXPECT_EQ(list.expiry().kept, exact);
    EXPECT_EQ(list.expiry().queries, exact);
    EXPECT_FALSE(list.is_stale(points, wider)) << "by half the skin";
    EXPECT_TRUE(list.is_stale(far, wider)) << "another box";
  }
  VerletList plain(make_cell_search(kRadius), params);
  plain.update(points, box);
  EXPECT_TRUE(plain.is_stale(far, box));
  EXPECT_EQ(plain.expiry().unknown, 1);
  EXPECT_EQ(plain.expiry().queries, 0);
}

}  // namespace
}  // namespace dch::expiry
