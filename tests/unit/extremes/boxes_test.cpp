// SPDX-License-Identifier: MIT
//
// Boxes of every size and aspect: refused with a reason, or each engine gives the pairs of long double.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "effort.hpp"
#include "error_message.hpp"
#include "listed_hierarchy.hpp"
#include "long_double_pairs.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// What became of the boxes of a sweep.
struct Tally {
  std::int64_t boxes = 0, refused = 0;   ///< refused as boxes
  std::int64_t lists = 0, no_lists = 0;  ///< by engine; not made, with a reason
  hard::PairComparison pairs;
};

std::optional<Box> box_of(Vec3 a, Vec3 b, Vec3 c, Box::Periodic periodic, Tally& tally) {
  ++tally.boxes;
  try {
    return Box::triclinic(a, b, c, periodic);
  } catch (const InvalidBox&) {
    ++tally.refused;
    return std::nullopt;
  }
}

void expect_figures(const Box& box) {
  const double volume = box.volume(), height = box.min_height();
  EXPECT_TRUE(std::isnormal(volume)) << volume;
  EXPECT_TRUE(std::isnormal(height) && std::isnormal(1 / height)) << height;
  EXPECT_TRUE(std::isnormal(box.shortest_period()));
  for (int k = 0; k < box.rank(); ++k) {
    const double dual2 = norm2(box.reduced_dual()[static_cast<std::size_t>(k)]);
    EXPECT_TRUE(std::isnormal(dual2)) << dual2;
  }
}

template <class MakeList>
void take_list(const MakeList& make_list, const std::vector<Vec3>& points, const Box& box, double radius,
               Tally& tally) {
  try {
    const NeighborList list = make_list();
    ++tally.lists;
    const hard::PairComparison compared = hard::compare_pairs(list, points, box, radius);
    EXPECT_TRUE(compared.is_right()) << compared.text();
    tally.pairs += compared;
  } catch (const Error& refusal) {
    ++tally.no_lists;
    EXPECT_THAT(refusal.what(), HasSubstr(";"));  // behind it stands the remedy
  }
}

/// Lists of a few points by every engine.
void expect_lists(const Box& box, Tally& tally) {
  const std::vector<Vec3> points = scenes::uniform_in(box, 7, 1);
  const double radius = 0.9 * box.max_cutoff();
  ListParams params;
  params.cutoffs = TypeCutoffs(radius);
  const auto take = [&](const auto& make_list) { take_list(make_list, points, box, radius, tally); };
  take([&] { return all_pairs(points, box, params); });
  for (const int divisions : {1, 3}) {
    take([&] {
      const auto cells = make_cell_search(radius, divisions);
      cells->update(points, box);
      return cells->list(params);
    });
  }
  take([&] {
    const auto hierarchy = make_dch_search(radius);
    hierarchy->update(points, box);
    EXPECT_EQ(hierarchy->validate(), "");
    return hierarchy->list(params);
  });
}

void take_box(Vec3 a, Vec3 b, Vec3 c, Tally& tally) {
  for (const Box::Periodic periodic :
       {Box::Periodic{true, true, true}, {true, true, false}, {false, true, true}, {false, true, false}}) {
    const std::optional<Box> box = box_of(a, b, c, periodic, tally);
    if (!box) continue;
    expect_figures(*box);
    expect_lists(*box, tally);
  }
}

/// With the edges for a diagonal, straight or skewed by some of each edge.
void take_edges(double x, double y, double z, const std::vector<double>& skews, Tally& tally) {
  for (const double skew : skews) take_box({x, 0, 0}, {skew * x, y, 0}, {0.5 * skew * x, skew * y, z}, tally);
}

/// One exponent in so many of one of the edges.
const int kStride = 4 / effort(4);

TEST(ExtremeBoxes, EdgesOfAnySizeAreRefusedOrRight) {
  Tally tally;
  int edges = 0;
  for (int a = -100; a <= 100; a += 10)
    for (int b = -100; b <= 100; b += 10)
      for (int c = -100; c <= 100; c += 10 * kStride) {
        ++edges;
        SCOPED_TRACE(std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(c));
        take_edges(std::pow(10, a), std::pow(10, b), std::pow(10, c), {0, 0.4, -3.7}, tally);
        ASSERT_FALSE(HasFailure());
      }
  EXPECT_EQ(tally.boxes, 12 * edges);
  EXPECT_GE(edges, effort(21 * 21 * 21));
  EXPECT_GT(tally.refused, tally.boxes / 2);
  EXPECT_GT(tally.boxes - tally.refused, effort(15000)) << "with one periodic vector, say";
  EXPECT_GT(tally.lists, effort(20000));
  EXPECT_GT(tally.pairs.pairs, 10 * tally.pairs.in_doubt) << tally.pairs.text();
  std::printf("%lld boxes, %lld accepted, %lld lists\n", static_cast<long long>(tally.boxes),
              static_cast<long long>(tally.boxes - tally.refused), static_cast<long long>(tally.lists));
}

TEST(ExtremeBoxes, AspectsUpToTheLimitAreRefusedOrRight) {
  Tally tally;
  for (const double unit : {1e-80, 1e-20, 1.0, 1e20, 1e80})
    for (int a = 0; a <= 14; a += kStride)
      for (int b = 0; b <= 14; ++b)
        for (const bool is_long : {false, true}) {
          SCOPED_TRACE(std::to_string(a) + ", " + std::to_string(b));
          const double sign = is_long ? 1 : -1;
          take_edges(unit, unit * std::pow(10, sign * a), unit * std::pow(10, sign * b), {0, 0.4}, tally);
          ASSERT_FALSE(HasFailure());
        }
  EXPECT_GT(tally.lists, effort(2000));
  EXPECT_GT(tally.pairs.pairs, tally.pairs.in_doubt) << tally.pairs.text();
}

/// All pairs look at every image of the cell as given, so its number is bounded too.
TEST(ExtremeBoxes, SkewsAreRefusedOrRight) {
  Tally tally;
  for (const double unit : {1e-100, 1.0, 1e90})
    for (double skew = 10; skew < 1e16; skew *= 10)
      for (const bool twice : {false, true}) {
        SCOPED_TRACE(skew);
        const Vec3 a{unit, 0, 0}, b{skew * unit, unit, 0};
        const Vec3 c{0.3 * unit, twice ? skew * unit : 0.4 * unit, unit};
        const std::optional<Box> box = box_of(a, b, c, {true, true, true}, tally);
        EXPECT_TRUE(skew <= 1e8 || !box.has_value());
        if (!box) continue;
        expect_figures(*box);
        if (skew < 1e6) expect_lists(*box, tally);  // long double would take its time over 1e7 images a pair
        ASSERT_FALSE(HasFailure());
      }
  EXPECT_GT(tally.lists, 30);
  EXPECT_GT(tally.pairs.pairs, tally.pairs.in_doubt) << tally.pairs.text();
}

// Off-axis components that are noise for the longest vector are none for the shortest.
TEST(ExtremeBoxes, TiltsAreKeptThatAreNoNoise) {
  const Box box = Box::triclinic({1e12, 0, 0}, {0.5, 1, 0}, {0, 0, 1});
  EXPECT_EQ(box.kind(), Box::Kind::triclinic);
  EXPECT_EQ(box.vector(1), (Vec3{0.5, 1, 0}));
  EXPECT_EQ(Box::triclinic({1e12, 0, 0}, {1e-13, 1, 0}, {0, 0, 1}).kind(), Box::Kind::orthorhombic);
}

TEST(ExtremeBoxes, RefusalsNameValueLimitAndRemedy) {
  const auto refusal = [](Vec3 a, Vec3 b, Vec3 c) {
    return test::message_of<InvalidBox>([&] { Box::triclinic(a, b, c); });
  };
  EXPECT_THAT(
      test::message_of<InvalidBox>([] {
        Box::orthorhombic({1e-100, 1, 1e100});
      }),
      AllOf(HasSubstr("1e+100 long"), HasSubstr("1e-100 high"), HasSubstr("1e+12"), HasSubstr("take")));
  EXPECT_THAT(refusal({1, 0, 0}, {1e4, 1e-4, 0}, {0, 0, 1e9}),
              AllOf(HasSubstr("1e+09 long"), HasSubstr("1e-04 high"), HasSubstr("take")));
  EXPECT_THAT(
      refusal({1e-100, 0, 0}, {0, 1e-100, 0}, {0, 1e-100, 1e-109}),
      AllOf(HasSubstr("volume"), HasSubstr("e-309"), HasSubstr("2.2250738585072014e-308"), HasSubstr("use")));
  EXPECT_THAT(refusal({1, 0, 0}, {1e4, 1, 0}, {0, 1e4, 1}),
              AllOf(HasSubstr("skewed"), HasSubstr("1e+07"), HasSubstr("give a reduced cell")));
  EXPECT_NO_THROW(Box::orthorhombic({1, 1, 1e100}, {true, true, false})) << "the long axis is open";
  EXPECT_NO_THROW(Box::orthorhombic({1.1e88, 1e100, 1e100}));
  EXPECT_NO_THROW(Box::orthorhombic({1.1e-100, 1e-88, 1.1e-100}));
  EXPECT_THROW(Box::orthorhombic({1, 1.1e12, 1}), InvalidBox);
}

TEST(ExtremeBoxes, ClustersOfManyPeriodsAreRefused) {
  StructureParams params;
  params.radius = 0.4;
  params.base_radius = 1e6;
  ListedHierarchy hierarchy(params);
  const std::vector<Vec3> points{{0, 0, 0}, {100, 0, 0}};
  const Box flat = Box::orthorhombic({1, 1e9, 1e9});
  EXPECT_THAT(test::message_of<InvalidParameter>([&] { hierarchy.build(points, flat); }),
              AllOf(HasSubstr("base_radius is 1e+06"), HasSubstr("16 times"), HasSubstr("leave it 0")));
  EXPECT_NO_THROW(hierarchy.build(points, Box::orthorhombic({1, 9, 9})))
      << "no cluster is wider than the box";
  EXPECT_THROW(hierarchy.update(points, flat), InvalidParameter);
  EXPECT_NO_THROW(hierarchy.build(points, Box::none()));
}

}  // namespace
}  // namespace dch
