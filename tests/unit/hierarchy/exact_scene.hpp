// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <dch/lists/all_pairs.hpp>

#include "hierarchy_test_access.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"

namespace dch {

/// R_0 = 1, rho_0 = 1.
inline StructureParams params_of(EdgeRule rule, int max_roots,
                                 MaintenancePolicy policy = MaintenancePolicy::always_repair) {
  StructureParams params;
  params.radius = rule == EdgeRule::thesis ? 2.1 : 1;
  if (rule == EdgeRule::additive) params.base_radius = 1;
  params.max_roots = max_roots;
  params.policy = policy;
  return params;
}

/// That every invariant holds, the list is the oracle's and no more edges are kept than there are.
inline void expect_right(ListedHierarchy& h, const std::vector<Vec3>& points, const Box& box) {
  ASSERT_EQ(h.validate(), "");
  ListParams params;
  params.cutoffs = TypeCutoffs(h.params().radius);
  NeighborList list;
  h.list(params, list);
  ASSERT_EQ(first_difference(list, all_pairs(points, box, params)), "");
  for (const auto& level : HierarchyTestAccess::impl(h).levels) {
    std::int64_t entries = 0;
    for (std::int32_t k = 0; k < level.size(); ++k)
      entries += static_cast<std::int64_t>(level.edges.row(k).size());
    ASSERT_EQ(level.edges.entries(), entries);
  }
}

}  // namespace dch
