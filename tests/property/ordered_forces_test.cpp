// SPDX-License-Identifier: MIT
//
// Forces of entries in another order stay what they are.
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/forces/lennard_jones.hpp>

#include "ordered_pairs.hpp"

namespace dch {
namespace {

using scenes::EntryOrder, scenes::kOrderedCutoff, scenes::kOrderedSkin, scenes::kOrderedTypes,
    scenes::kRefreshes;

class OrderedForces : public scenes::OrderedPairs {};

/// Potentials of each kind that kernels know, with what they need.
struct OrderedCase {
  std::string name;
  bool by_type = false, has_charges = false;
  std::function<LennardJones(const std::vector<std::int32_t>&)> make;
};

std::vector<double> cutoffs_of(int count) {
  return std::vector<double>(static_cast<std::size_t>(count) * static_cast<std::size_t>(count),
                             kOrderedCutoff);
}

LennardJones of_types() {
  std::vector<LennardJonesPair> matrix;
  for (int a = 0; a < kOrderedTypes; ++a)
    for (int b = 0; b < kOrderedTypes; ++b)
      matrix.push_back({0.5 + 0.1 * (a + b), 0.5 + 0.02 * (a + b), kOrderedCutoff - 0.03 * std::abs(a - b)});
  return {kOrderedTypes, matrix};
}

LennardJones of_particles(const std::vector<std::int32_t>& types) {
  std::vector<LennardJonesParticle> particles;
  for (const std::int32_t type : types) particles.push_back({0.4 + 0.2 * type, 0.5 + 0.03 * type});
  return {kOrderedCutoff, particles};
}

std::vector<OrderedCase> ordered_cases() {
  using Types = const std::vector<std::int32_t>&;
  const LennardJonesPair pair{1, 0.6, kOrderedCutoff};
  std::vector<OrderedCase> cases;
  cases.push_back({"one type", false, false, [=](Types) { return LennardJones(pair); }});
  cases.push_back({"types", true, false, [](Types) { return of_types(); }});
  cases.push_back({"particles", false, false, [](Types types) { return of_particles(types); }});
  const auto add = [&](const std::string& name, bool by_type, const CoulombTerm& term,
                       double switch_from = -1) {
    cases.push_back({name, by_type, true, [=](Types types) {
                       LennardJones potential = by_type ? of_types() : of_particles(types);
                       CoulombTerm charges = term;
                       charges.cutoffs = cutoffs_of(potential.types());
                       potential.set_coulomb(charges);
                       if (switch_from >= 0) potential.set_switch(switch_from);
                       return potential;
                     }});
  };
  add("types with charges", true, {2, 0, {}, 0, 0, false});
  add("types and Ewald", true, {2, 2.5, {}, 0, 0, false});
  add("particles in a reaction field", false, {2, 0, {}, 0.4, 1.4, false});
  add("particles and Ewald by a series", false, {2, 2.5, {}, 0, 0, true});
  add("particles, Ewald and a switch", false, {2, 2.5, {}, 0, 0, true}, 0.8);
  add("particles in a field with a switch", false, {2, 0, {}, 0.4, 1.4, false}, 0.8);
  cases.push_back({"dispersion", false, true, [](Types types) {
                     LennardJones potential = of_particles(types);
                     potential.set_coulomb({2, 2.5, cutoffs_of(1), 0, 0, true});
                     potential.set_dispersion({2.0, std::vector<double>(types.size(), 0.3)});
                     return potential;
                   }});
  return cases;
}

double rms(const std::vector<Vec3>& a, const std::vector<Vec3>* b = nullptr) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += norm2(b ? a[i] - (*b)[i] : a[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// At the search, and when all particles have moved by half the skin, in both precisions.
TEST_P(OrderedForces, GiveTheForcesOfThoseAsFound) {
  for (const OrderedCase& each : ordered_cases()) {
    SCOPED_TRACE(each.name);
    if (each.by_type) {
      request.cutoffs = TypeCutoffs(kOrderedTypes, cutoffs_of(kOrderedTypes));
      request.types = types;
    } else {
      request.cutoffs = TypeCutoffs(kOrderedCutoff);
      request.types = {};
    }
    LennardJones potential = each.make(types);
    const Span<const double> given = each.has_charges ? Span<const double>(charges) : Span<const double>();
    for (const EntryOrder order : scenes::kOrders) {
      ClusterPairs pairs = ordered(order), plain = searched(kRefreshes);
      scenes::Random random(5);
      std::vector<Vec3> moved = points;
      for (int step = 0; step < 2; ++step) {
        pairs.refresh(moved, box);
        plain.refresh(moved, box);
        std::vector<Vec3> expected(points.size());
        const LennardJonesSums sums_expected =
            potential.add_forces_and_sum(plain, ForcePrecision::double_precision, expected, given);
        for (const ForcePrecision precision : {ForcePrecision::double_precision, ForcePrecision::mixed}) {
          const double error = precision == ForcePrecision::mixed ? 3e-6 : 1e-13;
          std::vector<Vec3> found(points.size()), summed(points.size());
          potential.add_forces(pairs, precision, found, given);
          const LennardJonesSums sums = potential.add_forces_and_sum(pairs, precision, summed, given);
          EXPECT_LT(rms(found, &expected), error * rms(expected));
          EXPECT_LT(rms(summed, &expected), error * rms(expected));
          EXPECT_NEAR(sums.energy, sums_expected.energy, 4 * error * (std::abs(sums_expected.energy) + 250));
          EXPECT_NEAR(sums.virial[0], sums_expected.virial[0],
                      4 * error * (std::abs(sums_expected.virial[0]) + 250));
        }
        for (Vec3& p : moved) p = p + random.in_ball(0.499 * kOrderedSkin);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, OrderedForces, ::testing::ValuesIn(scenes::all_boxes(10.0)),
                         [](const auto& p) { return p.param.name; });

/// Integers of coordinates wrap at 2^32 units: two particles that far apart would stand in one place.
TEST(UnitsOfClusters, AreCoarserWhenAParticleGoesFar) {
  const std::vector<Vec3> points{{0, 0, 0}, {0.9, 0, 0}, {0, 0.9, 0}, {0, 0, 0.9}, {0.9, 0.9, 0}};
  ListParams request;
  request.cutoffs = TypeCutoffs(1.0);
  request.skin = 0.2;
  ListedHierarchy hierarchy = hierarchy_of(points, Box::none(), request.list_radius());
  ClusterPairs pairs;
  hierarchy.cluster_pairs(request, pairs);
  LennardJones potential({1, 0.8, 1.0});
  const double period = std::ldexp(pairs.unit, 32);
  for (const double far : {period, -period, 3 * period}) {
    std::vector<Vec3> moved = points;
    moved[1] = points[0] + Vec3{far, 0.01, 0};
    pairs.refresh(moved, Box::none());
    EXPECT_GT(std::ldexp(pairs.unit, 32), std::abs(far));
    std::vector<Vec3> mixed(points.size()), full(points.size());
    potential.add_forces(pairs, ForcePrecision::mixed, mixed);
    potential.add_forces(pairs, ForcePrecision::double_precision, full);
    EXPECT_EQ(norm2(mixed[1]), 0.0);
    EXPECT_LT(rms(mixed, &full), 1e-4 * rms(full));
  }
}

}  // namespace
}  // namespace dch
