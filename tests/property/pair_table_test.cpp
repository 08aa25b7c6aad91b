// SPDX-License-Identifier: MIT
//
// Tables of pair potentials where they begin and where they end; between, pair_potential_test.cpp.
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <dch/forces/pair_potential.hpp>

#include "form_oracle.hpp"
#include "instruction_sets.hpp"
#include "listed_hierarchy.hpp"

namespace dch::forms {
namespace {

/// Two points at a distance, and all ways to compute their force.
class TwoPoints {
 public:
  explicit TwoPoints(double distance) : points_{{1, 1, 1}, {1 + distance, 1, 1}} {
    ListedHierarchy hierarchy = hierarchy_of(points_, box_, kCutoff + kSkin);
    ListParams request = within_skin(kCutoff, kSkin);
    hierarchy.cluster_pairs(request, clusters_);
    request.order = RowOrder::unsorted;
    NeighborList list;
    hierarchy.list(request, list);
    make_pair_list(
        list, request.list_radius(), points_, box_, request.types,
        [](std::int32_t, std::int32_t) { return true; }, pairs_);
  }
  /// Along the line through both, on the second one.
  std::vector<double> forces(PairPotential& potential) const {
    std::vector<double> found;
    const auto take = [&](const auto& add) {
      std::vector<Vec3> forces(2);
      add(forces);
      EXPECT_TRUE(forces[0].x == -forces[1].x || std::isnan(forces[0].x + forces[1].x));
      found.push_back(forces[1].x);
    };
    for (const ForcePrecision precision : {ForcePrecision::double_precision, ForcePrecision::mixed}) {
      take([&](auto& f) { potential.add_forces(clusters_, precision, f); });
      take([&](auto& f) { potential.add_forces_and_sum(clusters_, precision, f); });
    }
    take([&](auto& f) { potential.add_forces(pairs_, points_, box_, f); });
    const std::vector<std::int32_t> i{0}, j{1}, none{0};
    take([&](auto& f) {
      potential.add_weighted({i, j, j, none, none, {1, 1, 1, 1}, {}}, points_, f, {}, nullptr);
    });
    PairBatch batch;
    const double distance = points_[1].x - points_[0].x;
    batch.r2[3] = distance * distance;
    potential.compute(batch, {1, 1, 1, 1}, {1, 1, 1, 1});
    found.push_back(batch.force_over_r[3] * (distance == 0 ? 1 : distance));
    return found;
  }

 private:
  Box box_ = Box::orthorhombic({9, 9, 9});
  std::vector<Vec3> points_;
  ClusterPairs clusters_;
  PairList pairs_;
};

constexpr PairForm kFormsWithTables[] = {PairForm::table, PairForm::spline};

PairPotential with_table(const PairTable& table, PairForm form) {
  PairPotentialParams params;
  params.form = form;
  params.pairs = {{{0, 0, 0}, table.outer, 0}};
  params.tables = {table};
  return PairPotential(params);
}

/// Of one type, with the force k / r at knot k from 0.
PairPotential rising(double inner, double outer, int knots, PairForm form) {
  PairTable table;
  table.inner = inner;
  table.outer = outer;
  for (int k = 0; k < knots; ++k) {
    table.force_over_r.push_back(k);
    table.energy.push_back(1);
  }
  if (form == PairForm::spline)
    table.force_bend = table.energy_bend = std::vector<double>(table.energy.size());
  return with_table(table, form);
}

TEST(PairTable, PairsCloserThanTheFirstKnotHaveNoNumberAsForce) {
  const RestoreInstructionSet restore;
  PairPotential lines = rising(0.5, 2.4, 100, PairForm::table),
                splines = rising(0.5, 2.4, 100, PairForm::spline);
  for (PairPotential* const either : {&lines, &splines})
    for (const InstructionSet set : supported_sets()) {
      PairPotential& potential = *either;
      set_instruction_set(set);
      for (const double distance : {0.0, 1e-30, 0.1, 0.4999})
        for (const double force : TwoPoints(distance).forces(potential))
          EXPECT_TRUE(std::isnan(force)) << name(set) << ", " << distance;
      for (const double distance : {0.5, 0.5001, 1.3, 2.3999}) {
        const double at = 99 * (distance * distance - 0.25) / (2.4 * 2.4 - 0.25) * distance;
        const std::vector<double> forces = TwoPoints(distance).forces(potential);
        for (std::size_t k = 0; k < forces.size(); ++k) {
          if (distance == 0.5 && (k == 2 || k == 3) && std::isnan(forces[k]))
            continue;  // closer by single precision
          EXPECT_NEAR(forces[k], at, 1e-4) << name(set) << ", " << distance << ", " << k;
        }
      }
      for (const double force : TwoPoints(2.4001).forces(potential)) EXPECT_EQ(force, 0) << name(set);
    }
}

/// In single precision distances near the end may seem to be beyond the last knot.
TEST(PairTable, ForcesGoOnUpToTheLastKnot) {
  const RestoreInstructionSet restore;
  constexpr int kKnots = 200000;
  for (const PairForm form : kFormsWithTables) {
    PairPotential potential = rising(2.3, 2.4, kKnots, form);
    for (int k = 1; k <= 40; ++k) {
      const TwoPoints points(2.4 * (1 - 3e-8 * k));
      for (const InstructionSet set : supported_sets()) {
        set_instruction_set(set);
        for (const double force : points.forces(potential))
          EXPECT_TRUE((force == 0 && k < 10) || std::abs(force - 2.4 * (kKnots - 1 - 0.147 * k)) < 2)
              << name(set) << ", " << k << ", " << force;
      }
    }
  }
}

/// A parabola of r^2 with its top a knot before the last one.
TEST(PairTable, SplinesAreBentUpToTheirEnd) {
  const RestoreInstructionSet restore;
  constexpr int kKnots = 200000;
  PairTable table{2.3, 2.4, {}, {}};
  const double apart = (2.4 * 2.4 - 2.3 * 2.3) / (kKnots - 1);
  for (int k = 0; k < kKnots; ++k) {
    const double before_top = k - (kKnots - 2);
    table.force_over_r.push_back(1e11 - before_top * before_top);
    table.force_bend.push_back(-2 / (apart * apart));
  }
  table.energy = table.energy_bend = std::vector<double>(kKnots);
  const PairPotential potential = with_table(table, PairForm::spline);
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    PairBatch batch;
    for (int k = 0; k < PairBatch::kSize; ++k) batch.r2[k] = 2.4 * 2.4 - 0.25 * (k + 1) * apart;
    potential.compute(batch, {1, 1, 1, 1}, {1, 1, 1, 1});
    for (int k = 0; k < PairBatch::kSize; ++k) {
      const double before_top = 0.75 - 0.25 * k;
      EXPECT_NEAR(batch.force_over_r[k], 1e11 - before_top * before_top, 1e-3) << name(set) << ", " << k;
    }
  }
}

TEST(PairTable, OneThatBeginsAtNoDistanceHasForcesThere) {
  const RestoreInstructionSet restore;
  const PairTable line{0, 2.4, {3, 1}, {5, 2}}, cubic{0, 2.4, {3, 1}, {5, 2}, {0.1, -4}, {2, 1}};
  PairPotential lines = with_table(line, PairForm::table), splines = with_table(cubic, PairForm::spline);
  for (PairPotential* const either : {&lines, &splines})
    for (const InstructionSet set : supported_sets()) {
      PairPotential& potential = *either;
      set_instruction_set(set);
      PairBatch batch;
      batch.r2[0] = 0;
      potential.compute(batch, {1, 1, 1, 1}, {1, 1, 1, 1});
      EXPECT_NEAR(batch.force_over_r[0], 3, 1e-12) << name(set);
      EXPECT_NEAR(batch.energy[0], 5, 1e-12) << name(set);
      for (const double force : TwoPoints(0).forces(potential)) EXPECT_FALSE(std::isnan(force)) << name(set);
    }
}

}  // namespace
}  // namespace dch::forms
