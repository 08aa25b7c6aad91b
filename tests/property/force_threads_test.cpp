// SPDX-License-Identifier: MIT
//
// The tasks that threads compute hold all rows and name what they say, and forces are the same bits however
// many threads there are.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "listed_hierarchy.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kThreadCutoff = 1.5;

class ForcesOnThreads : public ::testing::TestWithParam<scenes::NamedBox> {
 protected:
  /// Enough for several tasks, none near another one; some leave the cell.
  ForcesOnThreads() {
    constexpr int kSide = 26;
    scenes::Random random(11);
    for (int x = 0; x < kSide; ++x)
      for (int y = 0; y < kSide; ++y)
        for (int z = 0; z < kSide; ++z) {
          const Vec3 fraction = (1.0 / kSide) * Vec3{x + 0.0, y + 0.0, z + 0.0};
          const Vec3 at = box.kind() == Box::Kind::none ? double{kSide} * fraction
                                                        : scenes::from_fractional(box, fraction);
          points.push_back(at + random.in_ball(0.1));
          charges.push_back(random.uniform(-1, 1));
        }
    random.shuffle(points);
    request.cutoffs = TypeCutoffs(kThreadCutoff);
    request.skin = 0.2;
    HierarchyParams params;
    params.radius = request.list_radius();
    ListedHierarchy hierarchy(params);
    hierarchy.build(points, box);
    hierarchy.cluster_pairs(request, pairs);
  }

  struct Found {
    std::vector<Vec3> forces;
    LennardJonesSums sums;
  };
  Found compute(LennardJones& potential, ForcePrecision precision, Executor* executor) const {
    Found found{std::vector<Vec3>(points.size(), Vec3{0.125, 0, 0}), {}};
    potential.set_executor(executor);
    found.sums = potential.add_forces_and_sum(pairs, precision, found.forces, charges);
    potential.add_forces(pairs, precision, found.forces, charges);
    return found;
  }

  Box box = GetParam().box;
  std::vector<Vec3> points;
  std::vector<double> charges;
  ListParams request;
  ClusterPairs pairs;
};

TEST_P(ForcesOnThreads, AreTheSameBits) {
  LennardJones potential({1, 0.9, kThreadCutoff});
  potential.set_coulomb({1, 0, {kThreadCutoff}, 0, 0});
  for (const ForcePrecision precision : {ForcePrecision::mixed, ForcePrecision::double_precision}) {
    const Found expected = compute(potential, precision, nullptr);
    EXPECT_GT(norm2(expected.forces.front()), 0.0);
    for (const int threads : {1, 2, 3, 8, 1}) {
      const auto pool = make_thread_pool(threads);
      const Found found = compute(potential, precision, pool.get());
      ASSERT_EQ(found.forces, expected.forces) << threads << " threads";
      ASSERT_EQ(found.sums.energy, expected.sums.energy);
      ASSERT_EQ(found.sums.coulomb_energy, expected.sums.coulomb_energy);
      ASSERT_EQ(found.sums.virial, expected.sums.virial);
    }
  }
}

/// Two particles are brought to one place. With parameters or without, their forces have no value.
TEST_P(ForcesOnThreads, WhatIsNotFiniteIsLeftOutWhereItIsAskedFor) {
  std::vector<std::int32_t> pair;
  std::vector<Vec3> moved = points;
  pairs.for_each([&](std::int32_t i, std::int32_t j, const Vec3& apart) {
    const Vec3 at = points[static_cast<std::size_t>(i)];
    if (!pair.empty() || norm2(apart) > 1) return;
    if (norm2(points[static_cast<std::size_t>(j)] - at - apart) > 1e-12) return;  // another image
    pair = {std::min(i, j), std::max(i, j)};
    moved[static_cast<std::size_t>(j)] = at;
  });
  ASSERT_EQ(pair.size(), 2u);
  for (const double epsilon : {1.0, 0.0})
    for (const ForcePrecision precision : {ForcePrecision::mixed, ForcePrecision::double_precision}) {
      pairs.refresh(moved, box);
      LennardJones potential({epsilon, 0.9, kThreadCutoff});
      if (epsilon == 0) charges.clear();
      if (epsilon > 0) potential.set_coulomb({1, 0, {kThreadCutoff}, 0, 0});
      const Found with_all = compute(potential, precision, nullptr);
      std::vector<std::int32_t> unresolved{7};
      potential.set_unresolved(&unresolved);
      for (const int threads : {1, 3}) {
        const auto pool = make_thread_pool(threads);
        const Found found = compute(potential, precision, pool.get());
        EXPECT_EQ(unresolved, pair);
        EXPECT_FALSE(std::isfinite(found.sums.energy));
        for (std::size_t i = 0; i < points.size(); ++i) {
          const bool is_left_out =
              static_cast<std::int32_t>(i) == pair[0] || static_cast<std::int32_t>(i) == pair[1];
          ASSERT_NE(std::isfinite(norm2(with_all.forces[i])), is_left_out) << i;
          ASSERT_EQ(found.forces[i], is_left_out ? Vec3({0.125, 0, 0}) : with_all.forces[i]) << i;
        }
      }
      pairs.refresh(points, box);
      compute(potential, precision, nullptr);
      EXPECT_EQ(unresolved, std::vector<std::int32_t>());
    }
}

TEST_P(ForcesOnThreads, PositionsAreTakenAlike) {
  scenes::Random random(12);
  std::vector<Vec3> moved = points;
  for (Vec3& p : moved) p = p + random.in_ball(0.05);
  if (box.any_periodic() && box.periodic(0)) moved.front() = moved.front() + box.vector(0);
  ClusterPairs alone = pairs;
  alone.refresh(moved, box);
  for (const int threads : {2, 5}) {
    const auto pool = make_thread_pool(threads);
    ClusterPairs together = pairs;
    together.refresh(moved, box, pool.get());
    for (std::size_t c = 0; c < alone.at.size(); ++c)
      for (int slot = 0; slot < ClusterPairs::kSlots; ++slot) {
        ASSERT_EQ(together.at[c].x[slot], alone.at[c].x[slot]);
        ASSERT_EQ(together.at[c].z[slot], alone.at[c].z[slot]);
        ASSERT_EQ(together.at_in_units[c].y[slot], alone.at_in_units[c].y[slot]);
      }
    ASSERT_EQ(together.split_clusters.size(), alone.split_clusters.size());
    for (std::size_t k = 0; k < alone.split_clusters.size(); ++k)
      ASSERT_EQ(together.split_clusters[k].cluster, alone.split_clusters[k].cluster);
  }
}

TEST_P(ForcesOnThreads, TasksNameTheirOwnClustersAndLaterOnes) {
  const auto& tasks = pairs.tasks;
  ASSERT_GE(tasks.size(), 4u);
  ASSERT_EQ(pairs.first_row(tasks.front()), 0u);
  ASSERT_EQ(tasks.front().first_cluster, 0);
  ASSERT_EQ(pairs.first_row(tasks.back()) + 1, pairs.rows.size());
  ASSERT_EQ(tasks.back().first_cluster, pairs.clusters());
  std::vector<bool> has_earlier_contributions(pairs.at.size());
  for (std::size_t p = 0; p + 1 < tasks.size(); ++p) {
    std::vector<bool> is_listed(pairs.at.size());
    for (std::int64_t k = tasks[p].first_range; k < tasks[p + 1].first_range; ++k) {
      const ClusterPairs::Range range = pairs.ranges[static_cast<std::size_t>(k)];
      ASSERT_GE(range.first, tasks[p + 1].first_cluster);
      for (std::int32_t c = range.first; c < range.last; ++c) {
        ASSERT_FALSE(is_listed[static_cast<std::size_t>(c)]);
        is_listed[static_cast<std::size_t>(c)] = has_earlier_contributions[static_cast<std::size_t>(c)] =
            true;
      }
    }
    for (std::size_t r = pairs.first_row(tasks[p]); r < pairs.first_row(tasks[p + 1]); ++r) {
      const ClusterPairs::Row& row = pairs.rows[r];
      ASSERT_GE(row.cluster, tasks[p].first_cluster);
      ASSERT_LT(row.cluster, tasks[p + 1].first_cluster);
      for (std::int64_t e = row.first; e < pairs.rows[r + 1].first; ++e) {
        const std::int32_t c = pairs.entries[static_cast<std::size_t>(e)].cluster;
        const bool is_own = c >= tasks[p].first_cluster && c < tasks[p + 1].first_cluster;
        ASSERT_TRUE(is_own || is_listed[static_cast<std::size_t>(c)]) << "task " << p << ", cluster " << c;
      }
    }
  }
  for (std::size_t c = 0; c < pairs.at.size(); ++c) {
    const bool is_marked = pairs.has_earlier_contributions[static_cast<std::size_t>(pairs.origin_of[c])] != 0;
    ASSERT_TRUE(is_marked || !has_earlier_contributions[c]) << c;
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, ForcesOnThreads, ::testing::ValuesIn(scenes::all_boxes(26.0)),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace dch
