// SPDX-License-Identifier: MIT
//
// What PairPotential tallies by particle is half of what each of a particle's pairs adds, and the same bits
// on any number of threads.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/forces/pair_potential.hpp>

#include "form_oracle.hpp"
#include "instruction_sets.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch::forms {
namespace {

using Halves = std::vector<LennardJonesSums>;

void add_half(const LennardJonesSums& pair, LennardJonesSums& to) {
  to.energy += 0.5 * pair.energy;
  to.coulomb_energy += 0.5 * pair.coulomb_energy;
  for (std::size_t k = 0; k < 6; ++k) to.virial[k] += 0.5 * pair.virial[k];
}

/// What a pair adds, taken from the forms written once more, given to both.
void add_pair(const Case& one, const Scene& scene, std::size_t i, std::size_t j, Vec3 d, Weights weights,
              LennardJonesResult& scratch, Halves& halves) {
  scratch.sums = {};
  add(one.params, scene, i, j, d, weights, scratch);
  add_half(scratch.sums, halves[i]);
  add_half(scratch.sums, halves[j]);
}

Halves halves_of_all_pairs(const Case& one, const Scene& scene) {
  const std::size_t n = scene.points.size();
  LennardJonesResult scratch;
  scratch.force.resize(n);
  Halves halves(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      add_pair(one, scene, i, j, scene.box.nearest_image(scene.points[j] - scene.points[i]), {}, scratch,
               halves);
  return halves;
}

/// Root mean squares of the numbers' differences over those of the numbers: energies, those of charges and
/// the virial, whichever is the largest.
double error_of(const Halves& found, const Halves& expected) {
  double difference2[3]{}, size2[3]{};
  const auto compare = [&](int kind, double a, double b) {
    difference2[kind] += (a - b) * (a - b);
    size2[kind] += b * b;
  };
  for (std::size_t i = 0; i < expected.size(); ++i) {
    compare(0, found[i].energy, expected[i].energy);
    compare(1, found[i].coulomb_energy, expected[i].coulomb_energy);
    for (std::size_t k = 0; k < 6; ++k) compare(2, found[i].virial[k], expected[i].virial[k]);
  }
  double error = 0;
  for (int kind = 0; kind < 3; ++kind)
    error = std::max(error, std::sqrt(difference2[kind] / (size2[kind] > 0 ? size2[kind] : 1)));
  return error;
}

/// Twice half of everything is everything.
LennardJonesSums sum_of(const Halves& halves) {
  LennardJonesSums sum;
  for (const LennardJonesSums& one : halves) add_half(one, sum);
  sum.energy *= 2;
  sum.coulomb_energy *= 2;
  for (double& v : sum.virial) v *= 2;
  return sum;
}

TEST(PairTallies, OfClusterPairsAreHalvesOfAllPairs) {
  const RestoreInstructionSet restore;
  for (const Case& one : cases()) {
    const Scene scene(one.params.types);
    const Halves expected = halves_of_all_pairs(one, scene);
    const std::vector<double> charges = charges_for(one, scene);
    ListedHierarchy hierarchy = hierarchy_of(scene.points, scene.box, kCutoff + kSkin);
    PairPotential potential(one.params);
    for (const ClusterPairs::EntryOrder order :
         {ClusterPairs::EntryOrder::as_found, ClusterPairs::EntryOrder::by_halves,
          ClusterPairs::EntryOrder::by_image_and_halves, ClusterPairs::EntryOrder::joined}) {
      ClusterPairs pairs;
      hierarchy.cluster_pairs(request_of(one, scene), pairs);
      pairs.refreshes_before = 100;
      pairs.order_entries(order);
      ASSERT_EQ(pairs.entry_order, order);
      for (const InstructionSet set : supported_sets())
        for (const ForcePrecision precision : {ForcePrecision::double_precision, ForcePrecision::mixed}) {
          const bool is_mixed = precision == ForcePrecision::mixed;
          SCOPED_TRACE(std::string(one.name) + ", " + name(set) + (is_mixed ? ", mixed" : ""));
          set_instruction_set(set);
          const double limit = is_mixed ? std::max(1e-5, one.limit) : one.limit;
          std::vector<Vec3> forces(scene.points.size()), without(scene.points.size());
          Halves halves(scene.points.size());
          halves[7].energy = 3;
          const LennardJonesSums sums =
              potential.add_forces_and_tally(pairs, precision, forces, halves, charges);
          halves[7].energy -= 3;
          const LennardJonesSums same = potential.add_forces_and_sum(pairs, precision, without, charges);
          EXPECT_LT(error_of(halves, expected), limit);
          expect_near(sum_of(halves), same, limit);
          expect_near(sums, same, limit);
          EXPECT_LT(force_error(forces, without), limit);
        }
    }
  }
}

TEST(PairTallies, OfPairsOneByOneAreHalvesOfAllPairs) {
  const RestoreInstructionSet restore;
  for (const Case& one : cases()) {
    const Scene scene(one.params.types);
    const Halves expected = halves_of_all_pairs(one, scene);
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
      std::vector<Vec3> forces(scene.points.size()), without(scene.points.size());
      Halves halves(scene.points.size());
      const LennardJonesSums sums =
          potential.add_forces_and_tally(pairs, scene.points, scene.box, forces, halves, charges);
      potential.add_forces(pairs, scene.points, scene.box, without, charges);
      EXPECT_LT(error_of(halves, expected), one.limit);
      expect_near(sum_of(halves), sums, one.limit);
      EXPECT_LT(force_error(forces, without), one.limit);
    }
  }
}

TEST(PairTallies, OfWeightedPairsAreTheirParts) {
  const RestoreInstructionSet restore;
  for (const Case& one : cases()) {
    const Scene scene(one.params.types);
    const std::vector<double> charges = charges_for(one, scene);
    std::vector<std::int32_t> i, j, types, kind;
    Halves expected(scene.points.size());
    LennardJonesResult scratch;
    scratch.force.resize(scene.points.size());
    for (std::size_t a = 0; a + 9 < scene.points.size(); ++a) {
      const std::size_t b = a + 1 + a % 9, k = a % 4;
      i.push_back(static_cast<std::int32_t>(a));
      j.push_back(static_cast<std::int32_t>(b));
      types.push_back(scene.types[a] * one.params.types + scene.types[b]);
      kind.push_back(static_cast<std::int32_t>(k));
      add_pair(one, scene, a, b, scene.points[b] - scene.points[a], {kWeight[k], kChargeWeight[k]}, scratch,
               expected);
    }
    const PairPotential potential(one.params);
    for (const InstructionSet set : supported_sets()) {
      SCOPED_TRACE(std::string(one.name) + ", " + name(set));
      set_instruction_set(set);
      std::vector<Vec3> forces(scene.points.size()), without(scene.points.size());
      Halves halves(scene.points.size());
      const WeightedPairs pairs{i, j, j, types, kind, kWeight, kChargeWeight};
      LennardJonesSums sums;
      potential.add_weighted(pairs, scene.points, forces, charges, &sums, halves);
      potential.add_weighted(pairs, scene.points, without, charges, nullptr);
      EXPECT_LT(error_of(halves, expected), one.limit);
      expect_near(sum_of(halves), sums, one.limit);
      EXPECT_LT(force_error(forces, without), one.limit);
    }
  }
}

class PairTalliesOnThreads : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(PairTalliesOnThreads, AreTheSameBits) {
  constexpr int kSide = 26;
  const Box box = GetParam().box;
  std::vector<Vec3> points;
  std::vector<double> charges;
  scenes::Random random(11);
  for (int k = 0; k < kSide * kSide * kSide; ++k) {
    const Vec3 at = (1.0 / kSide) * Vec3{k % kSide + 0.0, k / kSide % kSide + 0.0, k / kSide / kSide + 0.0};
    points.push_back((box.kind() == Box::Kind::none ? double{kSide} * at : scenes::from_fractional(box, at)) +
                     random.in_ball(0.1));
    charges.push_back(random.uniform(-1, 1));
  }
  random.shuffle(points);
  ListedHierarchy hierarchy = hierarchy_of(points, box, 1.7);
  ClusterPairs pairs;
  hierarchy.cluster_pairs(within_skin(1.5, 0.2), pairs);
  ASSERT_GT(pairs.tasks.size(), 2u);
  PairPotential potential(params(PairForm::lennard_jones, ChargeForm::bare, 1, {{1, 0.9, 0}, 1.5, 1.5}));
  const auto compute = [&](ForcePrecision precision, Executor* executor) {
    potential.set_executor(executor);
    std::vector<Vec3> forces(points.size());
    Halves halves(points.size());
    const LennardJonesSums sums = potential.add_forces_and_tally(pairs, precision, forces, halves, charges);
    halves.push_back(sums);
    return halves;
  };
  for (const ForcePrecision precision : {ForcePrecision::mixed, ForcePrecision::double_precision}) {
    const Halves expected = compute(precision, nullptr);
    EXPECT_NE(expected.front().energy, 0);
    for (const int threads : {2, 3, 8, 1}) {
      const auto pool = make_thread_pool(threads);
      const Halves found = compute(precision, pool.get());
      for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(found[i].energy, expected[i].energy) << i << ", " << threads << " threads";
        ASSERT_EQ(found[i].coulomb_energy, expected[i].coulomb_energy);
        ASSERT_EQ(found[i].virial, expected[i].virial);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, PairTalliesOnThreads, ::testing::ValuesIn(scenes::all_boxes(26.0)),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace dch::forms
