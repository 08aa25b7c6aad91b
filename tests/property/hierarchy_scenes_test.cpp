// SPDX-License-Identifier: MIT
//
// Every kind of point set in every kind of box: the structure is valid and its lists equal the oracle's.
#include <gtest/gtest.h>

#include <dch/base/executor.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/lists/all_pairs.hpp>

#include "instruction_sets.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"
#include "shake.hpp"

namespace dch {
namespace {

std::vector<StructureParams> variants() {
  std::vector<StructureParams> all;
  for (const EdgeRule rule : {EdgeRule::additive, EdgeRule::thesis})
    for (const double c : {1.05, 1.5})
      for (const int max_roots : {1, 16}) {
        StructureParams params;
        params.radius = kRadius;
        params.edge_rule = rule;
        params.c = c;
        if (rule == EdgeRule::additive) params.base_radius = kRadius / (2 * c);  // small leaves: many levels
        params.max_roots = max_roots;
        all.push_back(params);
      }
  return all;
}

class HierarchyScenes : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(HierarchyScenes, ValidAfterBuild) {
  const Box box = GetParam().box;
  for (const StructureParams& params : variants())
    for (const std::size_t n : {0u, 1u, 2u, 3u, 17u, 100u, 400u})
      for (const scenes::NamedPoints& scene :
           scenes::hard_point_sets(box, n, params.radius / (2 * params.c))) {
        ListedHierarchy hierarchy(params);
        hierarchy.build(scene.points, box);
        ASSERT_EQ(hierarchy.validate(), "") << scene.name << ", n = " << n << ", c = " << params.c;
      }
}

TEST_P(HierarchyScenes, ListsEqualTheOracle) {
  const Box box = GetParam().box;
  for (const scenes::NamedPoints& scene : scenes::hard_point_sets(box, 300, kRadius / 2.1)) {
    std::vector<std::int32_t> types(scene.points.size());
    for (std::size_t i = 0; i < types.size(); ++i) types[i] = static_cast<std::int32_t>(i % 2);
    std::vector<IndexPair> bonds;
    for (std::size_t i = 0; i + 1 < types.size(); ++i)
      bonds.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(i + 1)});
    const Exclusions exclusions = Exclusions::from_bonds(types.size(), bonds, 2);

    for (const ListKind kind : {ListKind::half, ListKind::full}) {
      ListParams plain;
      plain.cutoffs = TypeCutoffs(0.8);
      plain.skin = 0.2;
      plain.kind = kind;
      ListParams typed = plain;
      typed.cutoffs = TypeCutoffs(2, {0.3, 0.0, 0.0, 0.8});
      typed.types = types;
      ListParams excluded = plain;
      excluded.exclusions = &exclusions;
      ListParams ghosts = plain;
      ghosts.first_ghost = static_cast<std::int32_t>(types.size() / 3);
      for (const ListParams& params : {plain, typed, excluded, ghosts}) {
        const NeighborList expected = all_pairs(scene.points, box, params);
        for (const double base_radius : {0.0, 0.2 * kRadius, kRadius}) {
          StructureParams hierarchy_params;
          hierarchy_params.radius = kRadius;
          hierarchy_params.base_radius = base_radius;
          ListedHierarchy hierarchy(hierarchy_params);
          hierarchy.build(scene.points, box);
          NeighborList first_set;
          for (const InstructionSet set : supported_sets()) {
            set_instruction_set(set);
            NeighborList list;
            hierarchy.list(params, list);
            ASSERT_EQ(first_difference(list, expected), "")
                << scene.name << ", R_0 = " << base_radius << ", " << name(set);
            ListParams as_found = params;
            as_found.order = RowOrder::unsorted;
            NeighborList other_order;
            hierarchy.list(as_found, other_order);
            if (set == InstructionSet::portable) first_set = other_order;
            ASSERT_EQ(first_difference(sorted_by_index(other_order, scene.points.size()), expected), "")
                << scene.name << ", R_0 = " << base_radius << ", " << name(set);
            ASSERT_EQ(first_difference(other_order, first_set), "") << "unsorted, " << name(set);
            for (std::size_t r = 0; params.first_ghost >= 0 && r < other_order.size(); ++r)
              ASSERT_TRUE(other_order.particle[r] < params.first_ghost || other_order.row(r).empty());
          }
        }
      }
    }
  }
}

// Leaves of hundreds of points, and of one or two; coordinates differ by many list radii within one.
TEST_P(HierarchyScenes, ListsDoNotDependOnTheSizeOfLeaves) {
  const Box box = GetParam().box;
  ListParams list_params;
  list_params.cutoffs = TypeCutoffs(0.5 * kRadius);
  for (const double radius : {0.5, 0.25}) {
    list_params.cutoffs = TypeCutoffs(radius);
    const std::vector<Vec3> points = scenes::uniform_in(box, 2500, 12);
    const NeighborList expected = all_pairs(points, box, list_params);
    for (const double factor : {0.0, 0.25, 1.0, 2.0, 4.0, 8.0, 40.0}) {
      StructureParams params;
      params.radius = radius;
      params.base_radius = factor * radius;
      ListedHierarchy hierarchy(params);
      hierarchy.build(points, box);
      NeighborList list;
      hierarchy.list(list_params, list);
      ASSERT_EQ(first_difference(list, expected), "") << "R_0 = " << factor << " list radii";
    }
  }
}

TEST_P(HierarchyScenes, ListsDoNotDependOnTheNumberOfThreads) {
  const Box box = GetParam().box;
  const std::vector<Vec3> points = scenes::uniform_in(box, 3000, 13);
  ListParams list_params;
  list_params.cutoffs = TypeCutoffs(0.4);
  list_params.order = RowOrder::unsorted;
  NeighborList expected;
  for (const int threads : {1, 2, 3, 8}) {
    const auto pool = make_thread_pool(threads);
    StructureParams params;
    params.radius = 0.4;
    params.base_radius = 0.7;
    params.executor = pool.get();
    ListedHierarchy hierarchy(params);
    hierarchy.build(points, box);
    NeighborList list;
    for (int repeat = 0; repeat < 2; ++repeat) hierarchy.list(list_params, list);
    if (threads == 1) expected = list;
    ASSERT_EQ(list.particle, expected.particle) << threads << " threads";
    ASSERT_EQ(first_difference(list, expected), "") << threads << " threads";
  }
  list_params.order = RowOrder::by_index;
  EXPECT_EQ(first_difference(sorted_by_index(expected, points.size()), all_pairs(points, box, list_params)),
            "");
}

// All periodic heights equal two list radii: the largest list a box can serve, and the worst for wrapping.
TEST_P(HierarchyScenes, ListsEqualTheOracleInTheSmallestBox) {
  const Box box = GetParam().box;
  if (!box.any_periodic()) return;
  StructureParams params;
  params.radius = box.max_cutoff();
  ListParams list_params;
  list_params.cutoffs = TypeCutoffs(params.radius);
  for (const double share : {1.0, 0.999, 0.9, 0.7}) {  // of the largest list
    list_params.cutoffs = TypeCutoffs(share * params.radius);
    for (const double base_radius : {0.0, 0.3 * params.radius}) {
      params.base_radius = base_radius;
      for (const scenes::NamedPoints& scene :
           scenes::hard_point_sets(box, 150, params.radius / (2 * params.c))) {
        ListedHierarchy hierarchy(params);
        hierarchy.build(scene.points, box);
        ASSERT_EQ(hierarchy.validate(), "") << scene.name;
        NeighborList list;
        hierarchy.list(list_params, list);
        ASSERT_EQ(first_difference(list, all_pairs(scene.points, box, list_params)), "")
            << scene.name << ", share " << share << ", R_0 = " << base_radius;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, HierarchyScenes, ::testing::ValuesIn(scenes::all_boxes(5.0)),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace dch
