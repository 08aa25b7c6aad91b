// SPDX-License-Identifier: MIT
#include "geometry/position_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <dch/base/error.hpp>

#include "lists/list_check.hpp"
#include "special_numbers.hpp"

namespace dch::detail {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(CheckPositions, NamesIndexAndValue) {
  const auto check = [](Vec3 p) {
    return [p] { check_positions(std::vector<Vec3>{{0, 0, 0}, p}, Box::none()); };
  };
  EXPECT_THAT(check({1, kNaN, 2}), ThrowsMessage<InvalidPosition>(HasSubstr("position 1 = (1, nan, 2)")));
  EXPECT_THAT(check({1, 2, -kInfinity}), ThrowsMessage<InvalidPosition>(HasSubstr("(1, 2, -inf)")));
  EXPECT_THAT(check({1e101, 0, 0}), ThrowsMessage<InvalidPosition>(HasSubstr("beyond 1e+100")));
  EXPECT_NO_THROW(check({1e100, -1e100, 0})());
}

TEST(CheckPositions, RefusesWhatRoundingLosesInAPeriodicBox) {
  const Box box = Box::orthorhombic({10, 10, 10}, {true, true, false});
  const auto check = [&](Vec3 p) { return [&box, p] { check_positions(std::vector<Vec3>{p}, box); }; };
  EXPECT_NO_THROW(check({1e12, -1e12, 0})());
  EXPECT_NO_THROW(check({0, 0, 1e100})()) << "the axis is open";
  EXPECT_THAT(check({0, 1e16, 0}),
              ThrowsMessage<InvalidPosition>(AllOf(HasSubstr("position 0"), HasSubstr("wrap"))));
}

TEST(CheckPositions, RefusesMoreParticlesThanIndices) {
  const Vec3 p;
  const Span<const Vec3> too_many(&p, std::size_t{1} << 31);  // refused before it is read
  EXPECT_THROW(check_positions(too_many, Box::none()), InvalidParameter);
}

TEST(CheckRadius, NamesLimitAndRemedy) {
  const Box box = Box::orthorhombic({10, 20, 20});
  EXPECT_NO_THROW(check_radius(5, box));
  EXPECT_NO_THROW(check_radius(1e10, Box::none()));
  EXPECT_THAT(
      [&] { check_radius(5.125, box); },
      ThrowsMessage<CutoffTooLarge>(AllOf(HasSubstr("5.125"), HasSubstr("exceeds 5,"), HasSubstr("lower"))));
}

TEST(CheckListParams, RefusesWhatDoesNotFit) {
  ListParams params;
  params.cutoffs = TypeCutoffs(2.0);
  params.skin = 0.5;
  EXPECT_NO_THROW(check_list_params(params, 4, 2.5));
  EXPECT_THAT([&] { check_list_params(params, 4, 2.25); },
              ThrowsMessage<InvalidParameter>(AllOf(HasSubstr("2.5"), HasSubstr("2.25"))));
  for (const double skin : {-0.1, kNaN, kInfinity}) {
    ListParams bad = params;
    bad.skin = skin;
    EXPECT_THROW(check_list_params(bad, 4, 2.5), InvalidParameter) << skin;
  }

  const std::vector<std::int32_t> types{0, 1, 1, 0}, wrong_type{0, 2, 1, 0}, negative{0, -1, 1, 0};
  ListParams typed = params;
  typed.cutoffs = TypeCutoffs(2, {1, 2, 2, 1});
  EXPECT_THROW(check_list_params(typed, 4, 2.5), InvalidParameter) << "types are missing";
  EXPECT_NO_THROW(check_list_params(typed, 0, 2.5));
  typed.types = types;
  EXPECT_NO_THROW(check_list_params(typed, 4, 2.5));
  EXPECT_THROW(check_list_params(typed, 5, 2.5), InvalidParameter);
  typed.types = wrong_type;
  EXPECT_THAT([&] { check_list_params(typed, 4, 2.5); },
              ThrowsMessage<InvalidParameter>(HasSubstr("particle 1 has type 2")));
  typed.types = negative;
  EXPECT_THROW(check_list_params(typed, 4, 2.5), InvalidParameter);

  const std::vector<double> radii{1, 0, 0.5, 0.25}, none(4, 0.0);
  ListParams sized = params;
  sized.radii = radii;
  EXPECT_EQ(sized.list_radius(), 2.5);
  EXPECT_NO_THROW(check_list_params(sized, 4, 2.5));
  EXPECT_THAT([&] { check_list_params(sized, 5, 2.5); },
              ThrowsMessage<InvalidParameter>(AllOf(HasSubstr("4 radii"), HasSubstr("5 particles"))));
  EXPECT_THROW(check_list_params(sized, 4, 2.25), InvalidParameter);
  sized.radii = none;
  EXPECT_THAT([&] { check_list_params(sized, 4, 2.5); },
              ThrowsMessage<InvalidParameter>(HasSubstr("at least one must be > 0")));
  for (const double radius : {-0.5, kNaN, kInfinity}) {
    const std::vector<double> bad{1, 0.5, radius, 1};
    sized.radii = bad;
    EXPECT_THAT([&] { check_list_params(sized, 4, 2.5); },
                ThrowsMessage<InvalidParameter>(HasSubstr("particle 2 has the radius")))
        << radius;
  }

  const auto exclusions = Exclusions::from_pairs(4, std::vector<IndexPair>{{0, 1}});
  ListParams excluding = params;
  excluding.exclusions = &exclusions;
  EXPECT_NO_THROW(check_list_params(excluding, 4, 2.5));
  EXPECT_THROW(check_list_params(excluding, 3, 2.5), InvalidParameter);

  ListParams ghosts = params;
  ghosts.first_ghost = 4;
  EXPECT_NO_THROW(check_list_params(ghosts, 4, 2.5));
  EXPECT_THROW(check_list_params(ghosts, 3, 2.5), InvalidParameter);
}

TEST(WrapError, IsZeroWhereNothingIsWrapped) {
  EXPECT_EQ(WrapError(Box::none()).bound(1e12), 0);
  const WrapError slab(Box::orthorhombic({10, 10, 10}, {true, true, false}));
  EXPECT_EQ(slab.reach({3, -4, 1e12}), 7);
  EXPECT_GT(slab.bound(7), 0);
  EXPECT_LT(slab.bound(7), 1e-11);
}

TEST(WrapError, GrowsWithTheCoordinatesOfTheBox) {
  const auto bound_at = [](Vec3 corner) {
    return WrapError(Box::orthorhombic({10, 10, 10}, {true, true, false}, corner)).bound(0);
  };
  EXPECT_LT(bound_at({0, 0, 0}), 1e-11);
  EXPECT_EQ(bound_at({0, 0, 1e15}), bound_at({0, 0, 0})) << "no shift changes z";
  for (const double far : {1e12, 1e15}) {
    EXPECT_GT(bound_at({far, 0, 0}), 2 * far * std::numeric_limits<double>::epsilon());
    EXPECT_LT(bound_at({0, -far, 0}), 1e-13 * far);
  }
}

}  // namespace
}  // namespace dch::detail
