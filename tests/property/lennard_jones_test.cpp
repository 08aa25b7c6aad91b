// SPDX-License-Identifier: MIT
//
// Lennard-Jones forces of cluster pairs equal those of all pairs in plain double.
//
// More than 300 lines: every case goes through the same sums of all pairs, in all boxes.
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "instruction_sets.hpp"
#include "list_params.hpp"
#include "listed_hierarchy.hpp"
#include "lj_oracle.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kCutoff = 2.4, kSkin = 0.3;

/// A liquid: points no closer than about 0.9 sigma, so that forces are moderate.
std::vector<Vec3> liquid(const Box& box, std::size_t n, double closest, std::uint64_t seed) {
  scenes::Random random(seed);
  std::vector<Vec3> points;
  for (int trial = 0; trial < 200000 && points.size() < n; ++trial) {
    const Vec3 p = scenes::from_fractional(box, {random.uniform(), random.uniform(), random.uniform()});
    bool fits = true;
    for (const Vec3 q : points) fits = fits && norm2(box.nearest_image(p - q)) > closest * closest;
    if (fits) points.push_back(p);
  }
  return points;
}

/// The nearest images of skewed cells cost the oracle itself some digits.
double rounding_in(const Box& box) { return box.kind() == Box::Kind::triclinic ? 5e-14 : 1e-14; }

void expect_equal(const LennardJonesResult& expected, const ClusterPairs& pairs, LennardJones& potential,
                  const std::string& what, const std::vector<double>& charges = {}) {
  const RestoreInstructionSet restore;
  for (const InstructionSet set : supported_sets())
    for (const ForcePrecision precision : {ForcePrecision::double_precision, ForcePrecision::mixed}) {
      set_instruction_set(set);
      const bool full = precision == ForcePrecision::double_precision;
      // A liquid averages over many pairs; here a few close ones may make up all of the force.
      const double limit = full ? rounding_in(pairs.box) : 1e-5;
      const std::string where = what + ", " + name(set) + (full ? ", full" : ", mixed");
      std::vector<Vec3> forces(expected.force.size()), once_more(expected.force.size());
      const LennardJonesSums sums = potential.add_forces_and_sum(pairs, precision, forces, charges);
      potential.add_forces(pairs, precision, once_more, charges);
      EXPECT_LT(force_error(forces, expected.force), limit) << where;
      EXPECT_LT(force_error(once_more, expected.force), limit) << where;
      double scale = std::abs(expected.sums.energy) + std::abs(expected.sums.coulomb_energy);
      for (const double v : expected.sums.virial) scale += std::abs(v);
      EXPECT_NEAR(sums.energy, expected.sums.energy, (full ? 1e-13 : 1e-5) * scale) << where;
      EXPECT_NEAR(sums.coulomb_energy, expected.sums.coulomb_energy, (full ? 1e-13 : 1e-5) * scale) << where;
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_NEAR(sums.virial[k], expected.sums.virial[k], (full ? 1e-13 : 1e-5) * scale) << where << k;
    }
}

PairList pair_list_of(ListedHierarchy& hierarchy, const ListParams& request, const std::vector<Vec3>& points,
                      const Box& box) {
  NeighborList list;
  PairList pairs;
  ListParams unsorted = request;
  unsorted.order = RowOrder::unsorted;
  unsorted.shell = request.skin;
  hierarchy.list(unsorted, list);
  const auto all = [](std::int32_t, std::int32_t) { return true; };
  make_pair_list(list, request.list_radius(), points, box, request.types, all, pairs);
  EXPECT_EQ(pairs.pairs(), list.pairs());
  return pairs;
}

void expect_equal(const LennardJonesResult& expected, const PairList& pairs, const std::vector<Vec3>& points,
                  const Box& box, const LennardJones& potential, const std::string& what,
                  const std::vector<double>& charges = {}) {
  const RestoreInstructionSet restore;
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    const std::string where = what + ", pair list, " + name(set);
    std::vector<Vec3> forces(expected.force.size()), once_more(expected.force.size());
    const LennardJonesSums sums = potential.add_forces_and_sum(pairs, points, box, forces, charges);
    potential.add_forces(pairs, points, box, once_more, charges);
    EXPECT_LT(force_error(forces, expected.force), rounding_in(box)) << where;
    EXPECT_LT(force_error(once_more, expected.force), rounding_in(box)) << where;
    double scale = std::abs(expected.sums.energy) + std::abs(expected.sums.coulomb_energy);
    for (const double v : expected.sums.virial) scale += std::abs(v);
    EXPECT_NEAR(sums.energy, expected.sums.energy, 1e-13 * scale) << where;
    EXPECT_NEAR(sums.coulomb_energy, expected.sums.coulomb_energy, 1e-13 * scale) << where;
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(sums.virial[k], expected.sums.virial[k], 1e-13 * scale) << where << k;
  }
}

class LennardJonesScenes : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(LennardJonesScenes, EqualsAllPairs) {
  const Box box = GetParam().box;
  for (const std::size_t n : {0u, 1u, 2u, 5u, 400u})
    for (const bool shifted : {false, true}) {
      const std::vector<Vec3> points = liquid(box, n, 0.85, 21 + n);
      HierarchyParams params;
      params.radius = kCutoff + kSkin;
      ListedHierarchy hierarchy(params);
      hierarchy.build(points, box);
      ClusterPairs pairs;
      hierarchy.cluster_pairs(within_skin(kCutoff, kSkin), pairs);
      const LennardJonesPair pair{0.7, 0.95, kCutoff};
      LennardJones potential(pair, shifted);
      const LennardJonesResult expected = all_pairs_lennard_jones(points, box, {pair}, shifted);
      expect_equal(expected, pairs, potential, "n = " + std::to_string(n));
      const PairList one_by_one = pair_list_of(hierarchy, within_skin(kCutoff, kSkin), points, box);
      expect_equal(expected, one_by_one, points, box, potential, "n = " + std::to_string(n));
    }
}

TEST_P(LennardJonesScenes, EqualsAllPairsAfterMotion) {
  const Box box = GetParam().box;
  scenes::Random random(4);
  const std::vector<Vec3> points = liquid(box, 500, 1.15, 6);
  HierarchyParams params;
  params.radius = kCutoff + kSkin;
  ListedHierarchy hierarchy(params);
  hierarchy.build(points, box);
  ClusterPairs pairs;
  hierarchy.cluster_pairs(within_skin(kCutoff, kSkin), pairs);
  const LennardJonesPair pair{1, 1, kCutoff};
  const PairList one_by_one = pair_list_of(hierarchy, within_skin(kCutoff, kSkin), points, box);
  LennardJones potential(pair);
  std::vector<Vec3> moved = points, wrapped = points;
  for (int step = 0; step < 3; ++step) {
    for (std::size_t i = 0; i < moved.size(); ++i) {
      moved[i] = moved[i] + random.in_ball(0.5 * kSkin / 3);
      wrapped[i] = box.wrap(moved[i]);
    }
    pairs.refresh(wrapped, box);
    const LennardJonesResult expected = all_pairs_lennard_jones(wrapped, box, {pair}, false);
    expect_equal(expected, pairs, potential, "step " + std::to_string(step));
    expect_equal(expected, one_by_one, moved, box, potential, "step " + std::to_string(step));
  }
}

TEST_P(LennardJonesScenes, EqualsAllPairsForManyTypesExclusionsAndGhosts) {
  const Box box = GetParam().box;
  for (const int types : {2, 4, 7}) {
    const std::vector<Vec3> points = liquid(box, 500, 0.85, 9);
    const auto side = static_cast<std::size_t>(types);
    std::vector<LennardJonesPair> matrix(side * side);
    std::vector<double> cutoffs(side * side);
    for (std::size_t a = 0; a < side; ++a)
      for (std::size_t b = 0; b < side; ++b) {
        const auto sum = static_cast<double>(a + b);
        matrix[a * side + b] = {1 + 0.1 * sum, 0.9 + 0.01 * sum, a + b == 2 ? 0 : kCutoff - 0.1 * sum};
        cutoffs[a * side + b] = matrix[a * side + b].cutoff;
      }
    std::vector<std::int32_t> type(points.size());
    std::vector<IndexPair> bonds;
    for (std::size_t i = 0; i < type.size(); ++i) {
      type[i] = static_cast<std::int32_t>(i % side);
      if (i > 0) bonds.push_back({static_cast<std::int32_t>(i - 1), static_cast<std::int32_t>(i)});
      for (std::size_t j = 0; j < i; ++j)
        if (norm2(box.nearest_image(points[i] - points[j])) < 0.9 * 0.9)
          bonds.push_back({static_cast<std::int32_t>(j), static_cast<std::int32_t>(i)});
    }
    const Exclusions exclusions = Exclusions::from_bonds(points.size(), bonds, 1);
    ListParams request;
    request.cutoffs = TypeCutoffs(types, cutoffs);
    request.skin = kSkin;
    request.types = type;
    request.exclusions = &exclusions;
    request.first_ghost = static_cast<std::int32_t>(points.size() / 2);
    HierarchyParams params;
    params.radius = kCutoff + kSkin;
    ListedHierarchy hierarchy(params);
    hierarchy.build(points, box);
    ClusterPairs pairs;
    hierarchy.cluster_pairs(request, pairs);
    LennardJones potential(types, matrix, true);
    const LennardJonesResult expected =
        all_pairs_lennard_jones(points, box, matrix, true, type, &exclusions, request.first_ghost);
    expect_equal(expected, pairs, potential, std::to_string(types) + " types");
    expect_equal(expected, pair_list_of(hierarchy, request, points, box), points, box, potential,
                 std::to_string(types) + " types");
  }
}

/// Cutoffs of charges below, at and beyond those of Lennard-Jones pairs.
TEST_P(LennardJonesScenes, EqualsAllPairsWithCharges) {
  const Box box = GetParam().box;
  for (const int types : {1, 3, 6})
    for (const double splitting : {0.0, 1.1, 40.0}) {
      const std::vector<Vec3> points = liquid(box, 400, 0.85, 13);
      const auto side = static_cast<std::size_t>(types);
      std::vector<LennardJonesPair> matrix(side * side);
      CoulombTerm term{3.5, splitting, std::vector<double>(side * side)};
      std::vector<double> cutoffs(side * side);
      for (std::size_t a = 0; a < side; ++a)
        for (std::size_t b = 0; b < side; ++b) {
          const auto sum = static_cast<double>(a + b);
          matrix[a * side + b] = {1 + 0.1 * sum, 0.9 + 0.01 * sum, a + b == 2 ? 0 : kCutoff - 0.1 * sum};
          term.cutoffs[a * side + b] = a + b == 3 ? 0 : kCutoff - 0.07 * sum * (a == b ? 2 : 1);
          cutoffs[a * side + b] = std::max(matrix[a * side + b].cutoff, term.cutoffs[a * side + b]);
        }
      std::vector<std::int32_t> type(points.size());
      std::vector<double> charges(points.size());
      scenes::Random random(8);
      for (std::size_t i = 0; i < type.size(); ++i) {
        type[i] = static_cast<std::int32_t>(i % side);
        charges[i] = 2 * random.uniform() - 1;
      }
      ListParams request;
      request.cutoffs = TypeCutoffs(types, cutoffs);
      request.skin = kSkin;
      if (types > 1) request.types = type;
      HierarchyParams params;
      params.radius = kCutoff + kSkin;
      ListedHierarchy hierarchy(params);
      hierarchy.build(points, box);
      ClusterPairs pairs;
      hierarchy.cluster_pairs(request, pairs);
      LennardJones potential(types, matrix, true);
      potential.set_coulomb(term);
      const LennardJonesResult expected =
          all_pairs_lennard_jones(points, box, matrix, true, type, nullptr, -1, {&term, charges});
      const std::string what = std::to_string(types) + " types, splitting " + std::to_string(splitting);
      expect_equal(expected, pairs, potential, what, charges);
      expect_equal(expected, pair_list_of(hierarchy, request, points, box), points, box, potential, what,
                   charges);
    }
}

INSTANTIATE_TEST_SUITE_P(Boxes, LennardJonesScenes, ::testing::ValuesIn(scenes::all_boxes(9.0)),
                         [](const auto& p) { return p.param.name; });

// A liquid as dense as the Lennard-Jones melt in a box that is many cutoffs wide and far from its origin:
// single precision must not feel the box.
TEST(LennardJonesTest, MixedPrecisionDoesNotDependOnTheBox) {
  const double side = 17;
  for (const double origin : {0.0, 4000.0}) {
    const Box box = Box::orthorhombic({side, side, 6}, {true, true, true}, {origin, origin, -origin});
    const std::vector<Vec3> points = liquid(box, 1100, 0.88, 30);
    HierarchyParams params;
    params.radius = 2.8;
    ListedHierarchy hierarchy(params);
    hierarchy.build(points, box);
    ClusterPairs pairs;
    hierarchy.cluster_pairs(within_skin(2.5, 0.3), pairs);
    const LennardJonesPair pair{1, 1, 2.5};
    LennardJones potential(pair);
    std::vector<Vec3> forces(points.size());
    potential.add_forces(pairs, ForcePrecision::mixed, forces);
    EXPECT_LT(force_error(forces, all_pairs_lennard_jones(points, box, {pair}, false).force), 2e-6) << origin;
  }
}

TEST(LennardJonesTest, AddsToTheForcesThatAreThere) {
  const std::vector<Vec3> points{{0, 0, 0}, {1.2, 0, 0}};
  HierarchyParams params;
  params.radius = 2;
  ListedHierarchy hierarchy(params);
  hierarchy.build(points, Box::none());
  ClusterPairs pairs;
  hierarchy.cluster_pairs(within_skin(2, 0), pairs);
  LennardJones potential({1, 1, 2});
  std::vector<Vec3> once(2), twice(2);
  potential.add_forces(pairs, ForcePrecision::double_precision, once);
  for (int repeat = 0; repeat < 2; ++repeat)
    potential.add_forces(pairs, ForcePrecision::double_precision, twice);
  EXPECT_NE(once[0].x, 0);
  EXPECT_EQ(twice[0].x, 2 * once[0].x);
  EXPECT_EQ(once[1].x, -once[0].x);
}

TEST(LennardJonesTest, RefusesWhatDoesNotFit) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  EXPECT_THROW(LennardJones({nan, 1, 2}), InvalidParameter);
  EXPECT_THROW(LennardJones({1, -1, 2}), InvalidParameter);
  EXPECT_THROW(LennardJones({1, 1, infinite}), InvalidParameter);
  EXPECT_THROW(LennardJones({1, 1e60, 2}), InvalidParameter);
  EXPECT_THROW(LennardJones(0, {}), InvalidParameter);
  EXPECT_THROW(LennardJones(2, {{1, 1, 2}, {1, 1, 2}, {1, 1, 2}}), InvalidParameter);
  EXPECT_THROW(LennardJones(2, {{1, 1, 2}, {1, 1, 2}, {1, 1.1, 2}, {1, 1, 2}}), InvalidParameter);

  const std::vector<Vec3> points{{0, 0, 0}, {1.2, 0, 0}};
  const std::vector<std::int32_t> types{0, 1};
  HierarchyParams params;
  params.radius = 2;
  ListedHierarchy hierarchy(params);
  hierarchy.build(points, Box::none());
  ClusterPairs pairs;
  ListParams request = within_skin(2, 0);
  request.cutoffs = TypeCutoffs(3, std::vector<double>(9, 2));
  request.types = types;
  hierarchy.cluster_pairs(request, pairs);
  std::vector<Vec3> forces(2), too_few(1);
  LennardJones potential({1, 1, 2}), too_far({1, 1, 2.1}), two_types(2, {4, {1, 1, 2}});
  LennardJones tiny({1, 1e-6, 2});
  EXPECT_THROW(potential.add_forces(pairs, ForcePrecision::double_precision, too_few), InvalidParameter);
  EXPECT_THROW(too_far.add_forces(pairs, ForcePrecision::double_precision, forces), InvalidParameter);
  EXPECT_THROW(two_types.add_forces(pairs, ForcePrecision::double_precision, forces), InvalidParameter);
  EXPECT_THROW(tiny.add_forces(pairs, ForcePrecision::mixed, forces), InvalidParameter);
  EXPECT_NO_THROW(tiny.add_forces(pairs, ForcePrecision::double_precision, forces));
}

TEST(LennardJonesTest, APairListFollowsACellThatChangesItsShape) {
  const Box box = Box::triclinic({7, 0, 0}, {1, 7, 0}, {0.5, -1, 7});
  const Box strained = Box::triclinic({7.02, 0, 0}, {1.03, 7.01, 0}, {0.5, -1.02, 6.99});
  const std::vector<Vec3> points = liquid(box, 250, 0.9, 3);
  std::vector<Vec3> moved;
  for (const Vec3 p : points) moved.push_back(scenes::from_fractional(strained, box.fractional(p)));
  HierarchyParams params;
  params.radius = kCutoff + kSkin;
  ListedHierarchy hierarchy(params);
  hierarchy.build(points, box);
  const PairList pairs = pair_list_of(hierarchy, within_skin(kCutoff, kSkin), points, box);
  EXPECT_GT(pairs.groups.size(), 5u);
  const LennardJonesPair pair{1, 1, kCutoff};
  expect_equal(all_pairs_lennard_jones(moved, strained, {pair}, false), pairs, moved, strained,
               LennardJones(pair), "strained");
  std::int64_t visited = 0;
  pairs.for_each(moved, strained, [&](std::int32_t i, std::int32_t j, Vec3 d) {
    ++visited;
    const Vec3 apart = moved[static_cast<std::size_t>(j)] - moved[static_cast<std::size_t>(i)];
    EXPECT_LT(norm2(strained.nearest_image(apart) - d), 1e-24);
  });
  EXPECT_EQ(visited, pairs.pairs());
}

TEST(LennardJonesTest, RefusesPairListsThatDoNotFit) {
  const Box box = Box::orthorhombic({9, 9, 9});
  const std::vector<Vec3> points = liquid(box, 50, 0.9, 3);
  HierarchyParams params;
  params.radius = 2;
  ListedHierarchy hierarchy(params);
  hierarchy.build(points, box);
  const auto all = [](std::int32_t, std::int32_t) { return true; };
  NeighborList half, full;
  hierarchy.list(within_skin(2, 0), half);
  ListParams both = within_skin(2, 0);
  both.kind = ListKind::full;
  hierarchy.list(both, full);
  PairList pairs;
  const std::vector<std::int32_t> too_few(49), negative(50, -1), three(50, 2);
  EXPECT_THROW(make_pair_list(full, 2, points, box, {}, all, pairs), InvalidParameter);
  EXPECT_THROW(make_pair_list(half, 2, {points.data(), 49}, box, {}, all, pairs), InvalidParameter);
  EXPECT_THROW(make_pair_list(half, 2, points, box, too_few, all, pairs), InvalidParameter);
  EXPECT_THROW(make_pair_list(half, 2, points, box, negative, all, pairs), InvalidParameter);
  make_pair_list(half, 2, points, box, three, all, pairs);
  std::vector<Vec3> forces(50), room(49);
  const LennardJones potential({1, 1, 2}), too_far({1, 1, 2.1}), two_types(2, {4, {1, 1, 2}});
  EXPECT_NO_THROW(potential.add_forces(pairs, points, box, forces));
  EXPECT_THROW(potential.add_forces(pairs, points, box, room), InvalidParameter);
  EXPECT_THROW(potential.add_forces(pairs, {points.data(), 49}, box, forces), InvalidParameter);
  EXPECT_THROW(potential.add_forces(pairs, points, Box::none(), forces), InvalidBox);
  EXPECT_THROW(too_far.add_forces(pairs, points, box, forces), InvalidParameter);
  EXPECT_THROW(two_types.add_forces(pairs, points, box, forces), InvalidParameter);
}

TEST(LennardJonesTest, RefusesChargesThatDoNotFit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  LennardJones potential(2, std::vector<LennardJonesPair>(4, {1, 1, 1.5}));
  const std::vector<double> cutoffs(4, 2), two{1, -1};
  EXPECT_THROW(potential.set_coulomb({-1, 0, cutoffs}), InvalidParameter);
  EXPECT_THROW(potential.set_coulomb({1, nan, cutoffs}), InvalidParameter);
  EXPECT_THROW(potential.set_coulomb({1, 0, {2, 2}}), InvalidParameter);
  EXPECT_THROW(potential.set_coulomb({1, 0, {2, 1, 2, 2}}), InvalidParameter);
  EXPECT_THROW(potential.set_coulomb({1, 0, {2, nan, nan, 2}}), InvalidParameter);

  const std::vector<Vec3> points{{0, 0, 0}, {1.8, 0, 0}};
  HierarchyParams params;
  params.radius = 2;
  ListedHierarchy hierarchy(params);
  hierarchy.build(points, Box::none());
  ClusterPairs pairs;
  hierarchy.cluster_pairs(within_skin(2, 0), pairs);
  std::vector<Vec3> forces(2);
  EXPECT_THROW(potential.add_forces(pairs, ForcePrecision::double_precision, forces, two), InvalidParameter);
  potential.set_coulomb({1, 0, cutoffs});
  EXPECT_EQ(potential.largest_cutoff(), 2);
  EXPECT_THROW(potential.add_forces(pairs, ForcePrecision::double_precision, forces), InvalidParameter);
  EXPECT_NO_THROW(potential.add_forces(pairs, ForcePrecision::double_precision, forces, two));
  EXPECT_NEAR(forces[0].x, 1 / (1.8 * 1.8), 1e-15);
  potential.set_coulomb({1, 0, {2.1, 2, 2, 2}});
  EXPECT_THROW(potential.add_forces(pairs, ForcePrecision::double_precision, forces, two), InvalidParameter);
}

}  // namespace
}  // namespace dch
