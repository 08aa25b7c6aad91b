// SPDX-License-Identifier: MIT
#include "lists/pair_filter.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/lists/all_pairs.hpp>

#include "geometry/position_check.hpp"
#include "scenes.hpp"

namespace dch::detail {
namespace {

/// Compares every decision of the filter, with and without a distance, with the oracle's list.
void expect_agreement(const std::vector<Vec3>& points, const Box& box, const ListParams& params,
                      const std::string& scene) {
  const WrapError error(box);
  const PairFilter filter(points, box, params, error.bound(check_positions(points, box)));
  const NeighborList expected = all_pairs(points, box, params);
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(points.size()); ++i) {
    const auto row = expected.row(static_cast<std::size_t>(i));
    for (std::int32_t j = i + 1; j < static_cast<std::int32_t>(points.size()); ++j) {
      const bool in_list = std::binary_search(row.begin(), row.end(), j);
      const double distance2 = box.distance2(box.wrap(points[i]), box.wrap(points[j]));
      ASSERT_EQ(filter.accept(i, j), in_list) << scene << ", pair " << i << ", " << j;
      ASSERT_EQ(filter.accept(j, i), in_list) << scene << ", pair " << j << ", " << i;
      ASSERT_EQ(filter.accept(i, j, distance2), in_list) << scene << ", pair " << i << ", " << j;
      ASSERT_EQ(filter.accept(j, i, distance2), in_list) << scene << ", pair " << j << ", " << i;
      ASSERT_TRUE(!in_list || distance2 <= filter.largest_distance2()) << scene;
    }
  }
}

TEST(PairFilter, EqualsTheOracleInEveryScene) {
  for (const auto& [box_name, box] : scenes::all_boxes(5)) {
    for (const auto& [set_name, points] : scenes::hard_point_sets(box, 120, 0.5)) {
      // 0.5 and its multiples are distances of the fcc and of the collinear set.
      for (const double reach : {0.5, 1.0, std::min(2.5, box.max_cutoff())}) {
        ListParams params;
        params.cutoffs = TypeCutoffs(reach);
        expect_agreement(points, box, params, box_name + ", " + set_name);
      }
    }
  }
}

TEST(PairFilter, DistancesAtTheCutoffInSpiteOfWrapping) {
  // Sites of a cubic lattice whose spacing is not a binary fraction, each moved by whole boxes: the wrapped
  // images round, and nearly every pair of neighbors is a tie.
  const double spacing = 0.1 * std::sqrt(2.0);
  for (const Box& box : {Box::orthorhombic({6 * spacing, 6 * spacing, 6 * spacing}),
                         Box::triclinic({6 * spacing, 0, 0}, {12 * spacing, 6 * spacing, 0},
                                        {3 * spacing, 0, 6 * spacing}, {true, true, true}, {1, 2, 3})}) {
    scenes::Random random(1);
    std::vector<Vec3> points;
    for (int k = 0; k < 216; ++k) {
      Vec3 p{spacing * (k % 6), spacing * (k / 6 % 6), spacing * (k / 36)};
      for (int axis = 0; axis < 3; ++axis) p = p + std::nearbyint(random.uniform(-30, 30)) * box.vector(axis);
      points.push_back(p);
    }
    for (const double factor : {1.0, std::sqrt(2.0), 2.0, 2.5}) {
      ListParams params;
      params.cutoffs = TypeCutoffs(std::min(factor * spacing, box.max_cutoff()));
      expect_agreement(points, box, params, box.description());
    }
  }
}

TEST(PairFilter, ErrorsLargerThanTheCutoffInventNoPairs) {
  // Wrapped images may coincide although the pair distance is farther than the cutoff.
  const Box box = Box::triclinic({10, 0, 0}, {10 / 3.0, 10, 0}, {-2.5, 10 / 7.0, 10});
  for (const double periods : {1e10, 1e11, 1e12}) {
    scenes::Random random(4);
    std::vector<Vec3> points;
    for (int k = 0; k < 120; ++k) {
      Vec3 p = random.in_ball(2e-4);
      for (int axis = 0; axis < 3; ++axis)
        p = p + std::nearbyint(random.uniform(-periods, periods)) * box.vector(axis);
      points.push_back(p);
    }
    for (const double cutoff : {1e-4, 1e-2}) {
      ListParams params;
      params.cutoffs = TypeCutoffs(cutoff);
      expect_agreement(points, box, params, std::to_string(periods) + " periods away");
    }
  }
}

TEST(PairFilter, ImagesOnBothSidesAtHalfTheBox) {
  // Each pair is half a period apart along one or more axes, give or take rounding.
  const Box box = Box::triclinic({1.4, 0, 0}, {0, 1.4, 0}, {0.7, 0.7, 1.1});
  std::vector<Vec3> points;
  for (int k = 0; k < 16; ++k) {
    const double nudge = 1e-16 * (k / 8);
    points.push_back((k & 1) * 0.5 * box.vector(0) + (k & 2) * 0.25 * box.vector(1) +
                     (k & 4) * 0.125 * box.vector(2) + Vec3{nudge, -nudge, 10 * nudge});
  }
  ListParams params;
  params.cutoffs = TypeCutoffs(box.max_cutoff());
  expect_agreement(points, box, params, "halves");
}

// Coordinates with few digits, for which nothing rounds: a distance of the cutoff is within it, the next
// larger one is not, be it of the positions, of an image or of two images half a period away.
TEST(PairFilter, ADistanceOfExactlyTheCutoffIsWithinIt) {
  const Vec3 a{8, 0, 0}, b{4, 8, 0}, c{0, 4, 16};
  for (const Box& box : {Box::none(), Box::orthorhombic({8, 16, 16}), Box::triclinic(a, b, c),
                         Box::triclinic(a, b, c, {true, false, false})})
    for (const double cutoff : {0.625, 2.5, 4.0}) {
      if (cutoff > box.max_cutoff()) continue;
      std::vector<Vec3> points{{1, 1, 1}};
      for (const double sign : {-1.0, 1.0}) {
        points.push_back({1 + sign * cutoff, 1, 1});
        points.push_back({1, 1 + sign * cutoff, 1});
        if (cutoff < 4) points.push_back({1 + sign * 3 * cutoff / 5, 1, 1 + sign * 4 * cutoff / 5});
      }
      const std::size_t within = points.size();
      for (std::size_t k = 1; k < within; ++k) {
        if (cutoff < 4) points.push_back(points[0] + (1 + 1e-15) * (points[k] - points[0]));
        points.push_back(points[k]);
        if (box.periodic(0)) points.back().x += (k % 2 == 0 ? 24 : -24);
      }
      ListParams params;
      params.cutoffs = TypeCutoffs(cutoff);
      ASSERT_NO_FATAL_FAILURE(expect_agreement(points, box, params, box.description()));
      const PairFilter filter(points, box, params, 0);
      for (std::size_t k = 1; k < within; ++k)
        EXPECT_TRUE(filter.accept(0, static_cast<std::int32_t>(k))) << box.description() << ", " << cutoff;
    }
}

TEST(PairFilter, EitherImageAtHalfTheBoxMayBeTheOneWithinTheCutoff) {
  // Of two images at half a period, rounding can put the one that seems the nearer beyond the cutoff.
  scenes::Random random(2);
  for (int trial = 0; trial < 900; ++trial) {
    const double side = random.uniform(1, 2);
    const Vec3 u{1 / 3.0, 2 / 3.0, 2 / 3.0}, v{2 / 3.0, 1 / 3.0, -2 / 3.0}, w{2 / 3.0, -2 / 3.0, 1 / 3.0};
    const Box box = trial % 3 == 0   ? Box::orthorhombic({side, 3, 3})
                    : trial % 3 == 1 ? Box::triclinic({side, 0, 0}, {5 * side, 3, 0}, {0, 1, 3})
                                     : Box::triclinic(side * u, 3.0 * v, 3.0 * w);
    std::vector<Vec3> points;
    for (int k = 0; k < 5; ++k) {
      const Vec3 p = random.uniform(-1, 1) * (k < 2 ? 10.0 : 1.0) * u;
      points.push_back(p);
      points.push_back(p + (random.uniform() < 0.5 ? 0.5 : 1.5) * box.vector(0));
    }
    // On either side, since which of the two images seems the nearer goes by the sign of the displacement.
    std::vector<Vec3> mirrored;
    for (const Vec3 p : points) mirrored.push_back(-1.0 * p);
    ListParams params;
    params.cutoffs = TypeCutoffs(box.max_cutoff());
    ASSERT_NO_FATAL_FAILURE(expect_agreement(points, box, params, "trial " + std::to_string(trial)));
    ASSERT_NO_FATAL_FAILURE(expect_agreement(mirrored, box, params, "mirrored " + std::to_string(trial)));
  }
}

TEST(PairFilter, TypesExclusionsAndGhosts) {
  const Box box = Box::orthorhombic({5, 5, 5});
  auto points = scenes::uniform_in(box, 150, 3);
  points[1] = points[0];  // coincident, of types whose cutoff is 0
  std::vector<std::int32_t> types(points.size());
  for (std::size_t i = 2; i < types.size(); ++i) types[i] = static_cast<std::int32_t>(i % 3);
  std::vector<IndexPair> bonds;
  for (std::int32_t i = 2; i + 1 < 150; ++i) bonds.push_back({i, i + 1});
  const auto exclusions = Exclusions::from_bonds(points.size(), bonds, 3);
  ListParams params;
  params.cutoffs = TypeCutoffs(3, {0, 1, 2, 1, 1.5, 0, 2, 0, 0.5});
  params.skin = 0.25;
  params.types = types;
  params.exclusions = &exclusions;
  params.first_ghost = 100;
  expect_agreement(points, box, params, "types, exclusions, ghosts");
}

TEST(PairFilter, Radii) {
  const Box box = Box::orthorhombic({5, 5, 5});
  auto points = scenes::uniform_in(box, 120, 8);
  points[3] = points[2];  // coincident, neither has a size
  std::vector<double> radii(points.size());
  for (std::size_t i = 4; i < radii.size(); ++i) radii[i] = 0.2 + 0.1 * static_cast<double>(i % 9);
  for (const double skin : {0.0, 0.3}) {
    ListParams params;
    params.radii = radii;
    params.skin = skin;
    expect_agreement(points, box, params, "skin " + std::to_string(skin));
    EXPECT_EQ(PairFilter(points, box, params, 0).least_radius(), 0);
    params.radii = Span<const double>(radii.data() + 4, radii.size() - 4);
    const Span<const Vec3> others(points.data() + 4, points.size() - 4);
    const PairFilter filter(others, box, params, 0.01);
    EXPECT_EQ(filter.least_radius(), 0.2);
    EXPECT_NEAR(filter.largest_distance2(), (2 + skin + 0.01) * (2 + skin + 0.01), 1e-12);
  }
}

/// Takes all pairs or none.
class Always : public TieBreaker {
 public:
  Always(double error, bool answer) : TieBreaker(error), answer_(answer) {}
  bool accepts(std::int32_t, std::int32_t) const override { return answer_; }

 private:
  bool answer_;
};

TEST(PairFilter, TheHostDecidesNearTheCutoffAlone) {
  const std::vector<Vec3> points{{0, 0, 0}, {0.9, 0, 0}, {2, 0, 0}, {0.9, 0, 0}};
  const std::vector<std::int32_t> types{0, 1, 0, 1};
  for (const bool answer : {false, true}) {
    const Always host(0.2, answer);
    ListParams params;
    params.tie_breaker = &host;
    params.types = types;
    params.cutoffs = TypeCutoffs(2, {1, 1, 1, 0});
    const PairFilter filter(points, Box::none(), params, params.cutoff_error());
    for (const double distance : {0.81, 1.0, 1.19}) {
      EXPECT_EQ(filter.accept(0, 1, distance * distance), answer) << distance;
      EXPECT_FALSE(filter.accept(1, 3, distance * distance)) << "types without a cutoff";
    }
    EXPECT_TRUE(filter.accept(0, 1, 0.79 * 0.79));
    EXPECT_FALSE(filter.accept(0, 1, 1.21 * 1.21));
    EXPECT_EQ(filter.accept(0, 1), answer);
    EXPECT_FALSE(filter.accept(1, 3)) << "types without a cutoff";

    const std::vector<double> radii{1, 0, 1, 0};
    params.radii = radii;
    const PairFilter by_radii(points, Box::none(), params, params.cutoff_error());
    EXPECT_EQ(by_radii.accept(1, 3), answer) << "points without a size at one place are at their cutoff";
  }
}

TEST(PairFilter, TheHostDecidesAboutCoincidentPointsWhereItsErrorIsTheCutoff) {
  const std::vector<Vec3> points{{0, 0, 0}, {0, 0, 0}};
  for (const bool answer : {false, true}) {
    const Always host(1, answer);
    ListParams params;
    params.tie_breaker = &host;
    const PairFilter filter(points, Box::none(), params, params.cutoff_error());
    EXPECT_EQ(filter.accept(0, 1, 0), answer);
  }
}

}  // namespace
}  // namespace dch::detail
