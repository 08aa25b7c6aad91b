// SPDX-License-Identifier: MIT
//
// Colloids whose spheres overlap, touch nearly, or are much larger than the solvent; else
// pair_potential_test.cpp.
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/forces/pair_potential.hpp>

#include "colloid_oracle.hpp"
#include "instruction_sets.hpp"
#include "list_params.hpp"
#include "listed_hierarchy.hpp"

namespace dch::forms {
namespace {

PairPotentialParams of_pair(std::array<double, 4> numbers, double cutoff) {
  PairPotentialParams params;
  params.form = PairForm::colloid;
  params.pairs = {{numbers, cutoff, 0}};
  return params;
}

/// Pairs of one particle with all others, which are on a line at these distances from it.
PairList in_a_row(const std::vector<double>& distances, double list_radius, std::vector<Vec3>& points) {
  PairList pairs;
  points = {{0, 0, 0}};
  for (const double distance : distances) {
    pairs.i.push_back(0);
    pairs.j.push_back(static_cast<std::int32_t>(points.size()));
    points.push_back({distance, 0, 0});
  }
  pairs.groups = {{{}, 0}, {{}, pairs.pairs()}};
  pairs.particles = points.size();
  pairs.list_radius = list_radius;
  pairs.box = Box::none();
  return pairs;
}

struct Kind {
  std::array<double, 4> numbers;  ///< of which the last is not the smaller diameter
  double cutoff;
};
constexpr Kind kKinds[] = {
    {{144, 1, 0, 0}, 2.5}, {{75.4, 1, 0, 50}, 29}, {{39.5, 1, 50, 50}, 55}, {{39.5, 1.2, 6, 50}, 33}};

TEST(PairColloid, LargeSpheresHaveTheForcesOfTheirEnergies) {
  const RestoreInstructionSet restore;
  for (const auto& [numbers, cutoff] : kKinds) {
    const double contact = (numbers[2] + numbers[3]) / 2;
    std::vector<double> distances;
    for (int k = 0; k < 29; ++k) distances.push_back(contact + 0.4 + 0.13 * k);
    std::vector<Vec3> points;
    const PairList pairs = in_a_row(distances, cutoff + 1, points);
    const PairPotential potential(of_pair(numbers, cutoff));
    for (const InstructionSet set : supported_sets()) {
      set_instruction_set(set);
      std::vector<Vec3> forces(points.size());
      const LennardJonesSums sums = potential.add_forces_and_sum(pairs, points, Box::none(), forces);
      double energy = 0, scale = 0;
      for (std::size_t k = 0; k < distances.size(); ++k) {
        const double r = distances[k];
        const Dual expected = r < cutoff ? energy_of_colloids(numbers, {r, 1}) : Dual{0, 0};
        EXPECT_NEAR(forces[k + 1].x, -expected.slope, 1e-10 * std::abs(expected.slope))
            << name(set) << ", " << r;
        energy += expected.value;
        scale += std::abs(expected.value);
      }
      EXPECT_NEAR(sums.energy, energy, 1e-10 * scale) << name(set);
    }
  }
}

TEST(PairColloid, OverlappingSpheresHaveNoFiniteForce) {
  const RestoreInstructionSet restore;
  for (const auto& [numbers, cutoff] : kKinds) {
    const double contact = (numbers[2] + numbers[3]) / 2;
    if (contact == 0) continue;
    for (const double part : {1e-3, 0.3, 0.8, 0.97, 1 - 1e-9, 1.0}) {
      // Among others that do not overlap, in any lane.
      std::vector<double> distances(21, contact + 1);
      const std::size_t which = static_cast<std::size_t>(part * 20);
      distances[which] = part * contact;
      std::vector<Vec3> points;
      const PairList pairs = in_a_row(distances, cutoff + 1, points);
      const PairPotential potential(of_pair(numbers, cutoff));
      for (const InstructionSet set : supported_sets()) {
        set_instruction_set(set);
        std::vector<Vec3> forces(points.size());
        potential.add_forces(pairs, points, Box::none(), forces);
        for (std::size_t k = 0; k < distances.size(); ++k)
          EXPECT_EQ(std::isfinite(forces[k + 1].x), k != which) << name(set) << ", " << part << ", " << k;
        PairBatch batch;
        batch.r2[5] = distances[which] * distances[which];
        potential.compute(batch, {1, 1, 1, 1}, {1, 1, 1, 1});
        EXPECT_FALSE(std::isfinite(batch.force_over_r[5])) << name(set) << ", " << part;
      }
    }
  }
}

TEST(PairColloid, OverlappingSpheresInClusterPairsHaveNoFiniteForce) {
  const RestoreInstructionSet restore;
  const Box box = Box::orthorhombic({12, 12, 12});
  const std::vector<Vec3> points{{1, 1, 1}, {2.4, 1, 1}, {6, 6, 6}, {8.6, 6, 6}};
  ListedHierarchy hierarchy = hierarchy_of(points, box, 4);
  ClusterPairs pairs;
  hierarchy.cluster_pairs(within_skin(3.5, 0.3), pairs);
  for (const double other : {0.0, 2.0}) {
    PairPotential potential(of_pair({40, 1, other, 4 - other}, 3.5));
    for (const InstructionSet set : supported_sets())
      for (const ForcePrecision precision : {ForcePrecision::double_precision, ForcePrecision::mixed}) {
        set_instruction_set(set);
        std::vector<Vec3> forces(points.size());
        potential.add_forces(pairs, precision, forces);
        for (std::size_t k = 0; k < points.size(); ++k)
          EXPECT_EQ(std::isfinite(forces[k].x), k >= 2) << name(set) << ", " << other << ", " << k;
      }
  }
}

TEST(PairColloid, NegativeDiametersAreRefused) {
  for (const std::size_t which : {std::size_t{2}, std::size_t{3}}) {
    std::array<double, 4> numbers{40, 1, 1, 1};
    numbers[which] = -1;
    try {
      const PairPotential potential(of_pair(numbers, 3));
      ADD_FAILURE() << "taken";
    } catch (const InvalidParameter& e) {
      EXPECT_NE(std::string(e.what()).find("diameter of types 0 and 0"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace dch::forms
