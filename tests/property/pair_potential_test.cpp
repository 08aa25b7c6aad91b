// SPDX-License-Identifier: MIT
//
// Forms of pair potentials, and of how charges act beside, equal what their energies give for all pairs.
#include <gtest/gtest.h>

#include <dch/base/error.hpp>
#include <dch/forces/pair_potential.hpp>

#include "form_oracle.hpp"
#include "instruction_sets.hpp"
#include "listed_hierarchy.hpp"

namespace dch::forms {
namespace {

TEST(PairPotential, ClusterPairsGiveTheForcesOfAllPairs) {
  const RestoreInstructionSet restore;
  for (Case& one : cases()) {
    const Scene scene(one.params.types);
    const LennardJonesResult expected = all_pairs(one.params, scene);
    const std::vector<double> charges = charges_for(one, scene);
    ListedHierarchy hierarchy = hierarchy_of(scene.points, scene.box, kCutoff + kSkin);
    ClusterPairs pairs;
    hierarchy.cluster_pairs(request_of(one, scene), pairs);
    PairPotential potential(one.params);
    for (const InstructionSet set : supported_sets())
      for (const ForcePrecision precision : {ForcePrecision::double_precision, ForcePrecision::mixed}) {
        const bool is_mixed = precision == ForcePrecision::mixed;
        SCOPED_TRACE(std::string(one.name) + ", " + name(set) + (is_mixed ? ", mixed" : ""));
        set_instruction_set(set);
        std::vector<Vec3> forces(scene.points.size()), once_more(scene.points.size());
        const double limit = is_mixed ? std::max(1e-5, one.limit) : one.limit;
        expect_near(potential.add_forces_and_sum(pairs, precision, forces, charges), expected.sums, limit);
        potential.add_forces(pairs, precision, once_more, charges);
        EXPECT_LT(force_error(forces, expected.force), limit);
        EXPECT_LT(force_error(once_more, expected.force), limit);
      }
  }
}

TEST(PairPotential, PairsOneByOneGiveTheForcesOfAllPairs) {
  const RestoreInstructionSet restore;
  for (Case& one : cases()) {
    const Scene scene(one.params.types);
    const LennardJonesResult expected = all_pairs(one.params, scene);
    const std::vector<double> charges = charges_for(one, scene);
    ListedHierarchy hierarchy = hierarchy_of(scene.points, scene.box, kCutoff + kSkin);
    ListParams request = request_of(one, scene);
    request.order = RowOrder::unsorted;
    NeighborList list;
    hierarchy.list(request, list);
    PairList pairs;
    make_pair_list(
        list, request.list_radius(), scene.points, scene.box, request.types,
        [](std::int32_t, std::int32_t) { return true; }, pairs);
    const PairPotential potential(one.params);
    for (const InstructionSet set : supported_sets()) {
      SCOPED_TRACE(std::string(one.name) + ", " + name(set));
      set_instruction_set(set);
      std::vector<Vec3> forces(scene.points.size()), once_more(scene.points.size());
      expect_near(potential.add_forces_and_sum(pairs, scene.points, scene.box, forces, charges),
                  expected.sums, one.limit);
      potential.add_forces(pairs, scene.points, scene.box, once_more, charges);
      EXPECT_LT(force_error(forces, expected.force), one.limit);
      EXPECT_LT(force_error(once_more, expected.force), one.limit);
    }
  }
}

/// Pairs of neighbors in the order of points, whose second one is, beyond the first half, an image at a place
/// of its own.
struct Bonded {
  Scene scene;
  std::vector<Vec3> places;
  std::vector<std::int32_t> i, j, at, types, kind;

  explicit Bonded(int kinds) : scene(kinds), places(scene.points) {
    const std::size_t n = scene.points.size();
    for (std::size_t a = 0; a + 5 < n; ++a) {
      const std::size_t b = a + 1 + a % 5;
      i.push_back(static_cast<std::int32_t>(a));
      j.push_back(static_cast<std::int32_t>(b));
      kind.push_back(static_cast<std::int32_t>(a % 4));
      types.push_back(scene.types[a] * kinds + scene.types[b]);
      at.push_back(static_cast<std::int32_t>(a < n / 2 ? b : places.size()));
      if (a >= n / 2)
        places.push_back(scene.points[a] + scene.box.nearest_image(scene.points[b] - scene.points[a]));
    }
  }
  WeightedPairs pairs() const { return {i, j, at, types, kind, kWeight, kChargeWeight}; }
  Vec3 displacement(std::size_t k) const {
    return places[static_cast<std::size_t>(at[k])] - scene.points[static_cast<std::size_t>(i[k])];
  }
  LennardJonesResult expected(const PairPotentialParams& params) const {
    LennardJonesResult result;
    result.force.resize(scene.points.size());
    for (std::size_t k = 0; k < i.size(); ++k)
      add(params, scene, static_cast<std::size_t>(i[k]), static_cast<std::size_t>(j[k]), displacement(k),
          {kWeight[static_cast<std::size_t>(kind[k])], kChargeWeight[static_cast<std::size_t>(kind[k])]},
          result);
    return result;
  }
};

TEST(PairPotential, WeightedPairsActByAPart) {
  const RestoreInstructionSet restore;
  for (Case& one : cases()) {
    const Bonded bonded(one.params.types);
    const LennardJonesResult expected = bonded.expected(one.params);
    const std::vector<double> charges = charges_for(one, bonded.scene);
    const PairPotential potential(one.params);
    for (const InstructionSet set : supported_sets()) {
      SCOPED_TRACE(std::string(one.name) + ", " + name(set));
      set_instruction_set(set);
      std::vector<Vec3> forces(bonded.scene.points.size()), once_more(bonded.scene.points.size());
      LennardJonesSums sums;
      potential.add_weighted(bonded.pairs(), bonded.places, forces, charges, &sums);
      potential.add_weighted(bonded.pairs(), bonded.places, once_more, charges, nullptr);
      expect_near(sums, expected.sums, one.limit);
      EXPECT_LT(force_error(forces, expected.force), one.limit);
      EXPECT_LT(force_error(once_more, expected.force), one.limit);
    }
  }
}

TEST(PairPotential, BatchesGiveWhatEachPairAdds) {
  const RestoreInstructionSet restore;
  for (Case& one : cases()) {
    const Bonded bonded(one.params.types);
    const PairPotential potential(one.params);
    for (const InstructionSet set : supported_sets()) {
      SCOPED_TRACE(std::string(one.name) + ", " + name(set));
      set_instruction_set(set);
      LennardJonesResult found;
      found.force.resize(bonded.scene.points.size());
      for (std::size_t k = 0; k < bonded.i.size(); ++k) {
        PairBatch batch;
        const auto i = static_cast<std::size_t>(bonded.i[k]), j = static_cast<std::size_t>(bonded.j[k]);
        const std::size_t lane = k % PairBatch::kSize;
        const Vec3 d = bonded.displacement(k);
        batch.r2[lane] = norm2(d);
        batch.charges[lane] = bonded.scene.charges[i] * bonded.scene.charges[j];
        batch.types[lane] = bonded.types[k];
        batch.kind[lane] = bonded.kind[k];
        potential.compute(batch, kWeight, kChargeWeight);
        const Vec3 f = batch.force_over_r[lane] * d;
        found.force[i] = found.force[i] - f;
        found.force[j] = found.force[j] + f;
        found.sums.energy += batch.energy[lane];
        found.sums.coulomb_energy += batch.coulomb_energy[lane];
      }
      const LennardJonesResult expected = bonded.expected(one.params);
      found.sums.virial = expected.sums.virial;
      expect_near(found.sums, expected.sums, one.limit);
      EXPECT_LT(force_error(found.force, expected.force), one.limit);
    }
  }
}

TEST(PairPotential, SoftPairsAtNoDistanceHaveTheirEnergy) {
  const RestoreInstructionSet restore;
  const Box box = Box::orthorhombic({9, 9, 9});
  const std::vector<Vec3> points{{1, 1, 1}, {1, 1, 1}};
  PairPotentialParams params;
  params.form = PairForm::soft;
  params.pairs = {{{3, 0, 0}, 2, 0}};
  ListedHierarchy hierarchy = hierarchy_of(points, box, kCutoff);
  ClusterPairs pairs;
  hierarchy.cluster_pairs(within_skin(2, kSkin), pairs);
  PairPotential potential(params);
  for (const InstructionSet set : supported_sets())
    for (const ForcePrecision precision : {ForcePrecision::double_precision, ForcePrecision::mixed}) {
      set_instruction_set(set);
      std::vector<Vec3> forces(2);
      EXPECT_NEAR(potential.add_forces_and_sum(pairs, precision, forces).energy, 6, 1e-5) << name(set);
      EXPECT_EQ(forces[0].x, 0) << name(set);
    }
}

TEST(PairPotential, SelfEnergyIsHalfOfThatOfTheImageAtTheCutoff) {
  const PairPotentialParams all =
      params(PairForm::lennard_jones, ChargeForm::damped_shifted, 1, {{1, 1, 0}, 2.2, 2.4});
  const double c = 2.4, x = all.splitting * c, root_pi = std::sqrt(std::acos(-1.0));
  const double slope = std::erfc(x) / (c * c) + 2 * all.splitting / root_pi * std::exp(-x * x) / c;
  const double expected = -(std::erfc(x) / c + slope * c) / 2 - all.splitting / root_pi;
  EXPECT_NEAR(PairPotential(all).self_energy(), all.constant * expected, 1e-14);
  EXPECT_EQ(PairPotential(params(PairForm::morse, ChargeForm::none, 1, {{1, 5, 1}, 2, 0})).self_energy(), 0);
}

}  // namespace
}  // namespace dch::forms
