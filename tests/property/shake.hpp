// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <dch/lists/all_pairs.hpp>

#include "effort.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {

inline constexpr double kRadius = 1.0;

inline ListParams whole_list() {
  ListParams params;
  params.cutoffs = TypeCutoffs(kRadius);
  return params;
}

/// Moves the points `full_steps` times (see effort()) by up to `step` along each axis and checks the
/// structure after every repair, the list after every tenth.
inline void shake(std::vector<Vec3> points, const Box& box, const StructureParams& params, double step,
                  int full_steps, std::uint64_t seed) {
  const int steps = effort(full_steps);
  scenes::Random random(seed);
  ListedHierarchy hierarchy(params);
  hierarchy.build(points, box);
  for (int s = 0; s < steps; ++s) {
    for (Vec3& p : points) p = p + random.in_cube(step);
    hierarchy.update(points, box);
    ASSERT_EQ(hierarchy.validate(), "") << "step " << s << ", displacement " << step << ", seed " << seed;
    if (s % 10 == 0) {
      NeighborList list;
      hierarchy.list(whole_list(), list);
      ASSERT_EQ(first_difference(list, all_pairs(points, box, whole_list())), "") << "step " << s;
    }
  }
  EXPECT_EQ(hierarchy.stats().builds, 1);
  EXPECT_EQ(hierarchy.stats().repairs, steps);
}

inline StructureParams repairing(EdgeRule rule = EdgeRule::additive, int max_roots = 16, double c = 1.05) {
  StructureParams params;
  params.radius = kRadius;
  params.policy = MaintenancePolicy::always_repair;
  params.edge_rule = rule;
  params.max_roots = max_roots;
  params.c = c;
  if (rule == EdgeRule::additive) params.base_radius = kRadius / (2 * c);  // small clusters: many levels
  return params;
}

inline double r0(const StructureParams& params) { return params.radius / (2 * params.c); }

}  // namespace dch
