// SPDX-License-Identifier: MIT
//
// Every kind of point set in every kind of box: the structure is valid and its lists equal the oracle's.
#include <gtest/gtest.h>

#include <dch/all_pairs.hpp>
#include <dch/hierarchy.hpp>

#include "list_compare.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kRadius = 1.0;

std::vector<HierarchyParams> variants() {
  std::vector<HierarchyParams> all;
  for (const EdgeRule rule : {EdgeRule::additive, EdgeRule::thesis})
    for (const double c : {1.05, 1.5})
      for (const int max_roots : {1, 16}) {
        HierarchyParams params;
        params.radius = kRadius;
        params.edge_rule = rule;
        params.c = c;
        params.max_roots = max_roots;
        all.push_back(params);
      }
  return all;
}

class HierarchyScenes : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(HierarchyScenes, ValidAfterBuild) {
  const Box box = GetParam().box;
  for (const HierarchyParams& params : variants())
    for (const std::size_t n : {0u, 1u, 2u, 3u, 17u, 100u, 400u})
      for (const scenes::NamedPoints& scene :
           scenes::hard_point_sets(box, n, params.radius / (2 * params.c))) {
        Hierarchy hierarchy(params);
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

    Hierarchy hierarchy([] {
      HierarchyParams params;
      params.radius = kRadius;
      return params;
    }());
    hierarchy.build(scene.points, box);
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
        NeighborList list;
        hierarchy.list(params, list);
        ASSERT_EQ(first_difference(list, all_pairs(scene.points, box, params)), "") << scene.name;
      }
    }
  }
}

// All periodic heights equal two list radii: the largest list a box can serve, and the worst for wrapping.
TEST_P(HierarchyScenes, ListsEqualTheOracleInTheSmallestBox) {
  const Box box = GetParam().box;
  if (!box.any_periodic()) return;
  HierarchyParams params;
  params.radius = box.max_cutoff();
  ListParams list_params;
  list_params.cutoffs = TypeCutoffs(params.radius);
  for (const scenes::NamedPoints& scene : scenes::hard_point_sets(box, 150, params.radius / (2 * params.c))) {
    Hierarchy hierarchy(params);
    hierarchy.build(scene.points, box);
    ASSERT_EQ(hierarchy.validate(), "") << scene.name;
    NeighborList list;
    hierarchy.list(list_params, list);
    ASSERT_EQ(first_difference(list, all_pairs(scene.points, box, list_params)), "") << scene.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, HierarchyScenes, ::testing::ValuesIn(scenes::all_boxes(5.0)),
                         [](const auto& p) { return p.param.name; });

TEST(HierarchyScenes, TheSameInputGivesTheSameHierarchy) {
  const Box box = Box::orthorhombic({5, 5, 5});
  const std::vector<Vec3> fcc = scenes::fcc(box, 0.5, 500);  // ties everywhere
  HierarchyParams params;
  params.radius = kRadius;
  params.c = 1.25;
  Hierarchy a(params), b(params);
  a.build(fcc, box);
  b.build(fcc, box);
  for (std::int32_t id = 0; id < static_cast<std::int32_t>(fcc.size()); ++id) {
    ASSERT_EQ(a.top_level(id), b.top_level(id));
    ASSERT_EQ(a.parent(id, 0), b.parent(id, 0));
  }
}

}  // namespace
}  // namespace dch
