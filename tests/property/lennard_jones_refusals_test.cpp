// SPDX-License-Identifier: MIT
//
// What LennardJones refuses, each with an exception.
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "listed_hierarchy.hpp"

namespace dch {
namespace {

/// All at one place, as cluster pairs and one by one.
struct ThreePoints {
  std::vector<Vec3> points = std::vector<Vec3>(3);
  ClusterPairs pairs;
  PairList one_by_one;

  ThreePoints() {
    HierarchyParams params;
    params.radius = 2;
    ListedHierarchy hierarchy(params);
    hierarchy.build(points, Box::none());
    ListParams request;
    request.cutoffs = TypeCutoffs(2);
    hierarchy.cluster_pairs(request, pairs);
    NeighborList list;
    hierarchy.list(request, list);
    make_pair_list(
        list, 2, points, Box::none(), {}, [](std::int32_t, std::int32_t) { return true; }, one_by_one);
  }
};

TEST(LennardJonesRefusals, OfWhatDoesNotFit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<LennardJonesParticle> two(2);
  EXPECT_THROW(LennardJones(0, two), InvalidParameter);
  EXPECT_THROW(LennardJones(nan, two), InvalidParameter);
  EXPECT_THROW(LennardJones(2, std::vector<LennardJonesParticle>{{1, -1}}), InvalidParameter);
  EXPECT_THROW(LennardJones(2, std::vector<LennardJonesParticle>{{nan, 1}}), InvalidParameter);

  const auto coulomb = [](double splitting, double cutoff, double quadratic, double offset) {
    return CoulombTerm{1, splitting, {cutoff}, quadratic, offset};
  };
  EXPECT_THROW(LennardJones({1, 1, 2}).set_coulomb(coulomb(0, 2, nan, 0)), InvalidParameter);
  EXPECT_THROW(LennardJones({1, 1, 2}).set_coulomb(coulomb(1, 2, 0.1, 0)), InvalidParameter);
  EXPECT_THROW(LennardJones({1, 1, 2}).set_coulomb(coulomb(0, 1.5, 0.1, 0)), InvalidParameter);
  EXPECT_THROW(LennardJones(2, two).set_coulomb(coulomb(1, 2, 0, 0)), InvalidParameter);
  EXPECT_THROW(LennardJones({1, 1, 2}).set_coulomb({1, 1, {1.5}, 0, 0, true}), InvalidParameter);
  EXPECT_THROW(LennardJones({1, 1, 2}).set_coulomb({1, 3.2, {2}, 0, 0, true}), InvalidParameter);
  EXPECT_THROW(LennardJones(2, two).set_coulomb(coulomb(0, 1.5, 0, 0)), InvalidParameter);

  LennardJones plain({1, 1, 2}), shifted({1, 1, 2}, true), ewald({1, 1, 2});
  ewald.set_coulomb(coulomb(1, 2, 0, 0));
  EXPECT_THROW(plain.set_switch(-0.1), InvalidParameter);
  EXPECT_THROW(plain.set_switch(2), InvalidParameter);
  EXPECT_THROW(plain.set_switch(nan), InvalidParameter);
  EXPECT_THROW(shifted.set_switch(1), InvalidParameter);
  EXPECT_THROW(ewald.set_switch(1), InvalidParameter);
  EXPECT_THROW(LennardJones(2, {{1, 1, 2}, {1, 1, 2}, {1, 1, 2}, {1, 1, 1.5}}).set_switch(1),
               InvalidParameter);
  plain.set_switch(1);
  EXPECT_THROW(plain.set_coulomb(coulomb(1, 2, 0, 0)), InvalidParameter);

  ThreePoints of;
  std::vector<Vec3> forces(3);
  LennardJones mixing(2, two), switched({1, 1, 2});
  switched.set_switch(1);
  EXPECT_THROW(mixing.add_forces(of.pairs, ForcePrecision::double_precision, forces), InvalidParameter);
  EXPECT_THROW(switched.add_forces(of.one_by_one, of.points, Box::none(), forces), InvalidParameter);
}

TEST(LennardJonesRefusals, OfDispersionThatDoesNotFit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<LennardJonesParticle> two(2);
  const DispersionTerm dispersion{1, {1, 1}};
  LennardJones mixed(2, two), by_type({1, 1, 2}, true), unshifted({1, 1, 2}), twice(2, two);
  for (LennardJones* const each : {&mixed, &by_type, &unshifted, &twice})
    each->set_coulomb({1, 1, {2}, 0, 0, true});
  EXPECT_THROW(LennardJones(2, two).set_dispersion(dispersion), InvalidParameter);
  LennardJones ewald({1, 1, 2});
  ewald.set_coulomb({1, 1, {2}});
  EXPECT_THROW(ewald.set_dispersion(dispersion), InvalidParameter);
  EXPECT_THROW(unshifted.set_dispersion(dispersion), InvalidParameter);
  for (const double bad : {0.0, -1.0, nan, 3.2})
    EXPECT_THROW(mixed.set_dispersion({bad, {1, 1}}), InvalidParameter) << bad;
  EXPECT_THROW(mixed.set_dispersion({1, {1, nan}}), InvalidParameter);
  mixed.set_dispersion(dispersion);
  by_type.set_dispersion(dispersion);
  EXPECT_THROW(mixed.set_switch(1), InvalidParameter);
  twice.set_switch(1);
  EXPECT_THROW(twice.set_dispersion(dispersion), InvalidParameter);
  EXPECT_TRUE(mixed.fits_single());
  by_type.set_dispersion({1, {1, 1e-30}});
  EXPECT_FALSE(by_type.fits_single());

  ThreePoints of;
  std::vector<Vec3> forces(3);
  const std::vector<double> three(3);
  by_type.set_dispersion(dispersion);
  EXPECT_THROW(by_type.add_forces(of.pairs, ForcePrecision::double_precision, forces, three),
               InvalidParameter);
  by_type.set_dispersion({1, {1, 1, 1}});
  EXPECT_THROW(by_type.add_forces(of.one_by_one, of.points, Box::none(), forces, three), InvalidParameter);
}

}  // namespace
}  // namespace dch
