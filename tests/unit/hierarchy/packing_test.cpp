// SPDX-License-Identifier: MIT
//
// How many edges and children a node may have: the packing lemma and what follows from it for the separation
// and the thresholds in use. Nodes of level i >= 1 are more than R_{i-1} apart and edges at most as long as
// the reach of the level, so in d dimensions a node has at most (2 reach_i / R_{i-1} + 1)^d - 1 of them.
// Nodes of level i >= 2 cover nodes more than R_{i-2} apart within R_{i-1}: at most 5^d, in fact 3, 19 and 87
// for d = 1, 2 and 3 (Sullivan 1994). Points have no separation, so level 1 may have any number of children.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <ostream>

#include "hierarchy_test_access.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr int kMaxChildren[] = {1, 3, 19, 87};  ///< by dimension

StructureParams params_for_packing(EdgeRule rule, MaintenancePolicy policy = MaintenancePolicy::automatic) {
  StructureParams params;
  params.radius = 1;
  params.edge_rule = rule;
  params.policy = policy;
  params.max_roots = 1;
  if (rule == EdgeRule::additive) params.base_radius = params.radius / (2 * params.c);
  return params;
}

/// Exact on a line, where the k-th node to one side is more than k separations away.
double largest_degree(int dimensions, double reach, double separation) {
  if (dimensions == 1) return 2 * (std::ceil(reach / separation) - 1);
  return std::pow(2 * reach / separation + 1, dimensions) - 1;
}

double separation(ListedHierarchy& h, int level) { return h.level(level - 1).covering_radius; }

/// The longest an edge of a level may be that has not moved.
double reach(ListedHierarchy& h, int level) {
  return h.level(level).edge_threshold + (level > 1 ? kEdgeSlack * h.level(level).covering_radius : 0);
}

int most_children(ListedHierarchy& h, int level) {
  std::map<std::int32_t, int> children;
  int most = 0;
  for (std::int32_t id = 0; id < static_cast<std::int32_t>(h.size()); ++id)
    if (h.top_level(id) >= level - 1) most = std::max(most, ++children[h.parent(id, level - 1)]);
  return most;
}

/// The first level that has a node with more edges or children than there is room for; 0 if none has.
int overfull_level(ListedHierarchy& h, int dimensions) {
  for (int i = 1; i < h.levels(); ++i) {
    if (static_cast<double>(h.level(i).max_degree) >
        largest_degree(dimensions, reach(h, i), separation(h, i)))
      return i;
    if (i > 1 && most_children(h, i) > kMaxChildren[dimensions]) return i;
  }
  return 0;
}

/// Joins all nodes of a level, as a search for edges that dismisses none would.
void join_all(HierarchyTestAccess::Impl& inside, int level) {
  auto& at = inside.levels[static_cast<std::size_t>(level)];
  for (std::int32_t a = 0; a < at.size(); ++a) {
    at.edges.clear_row(a);
    for (std::int32_t b = 0; b < at.size(); ++b)
      if (a != b && at.is_alive(a) && at.is_alive(b)) at.edges.push(a, b);
  }
}

struct DenseScene {
  int dimensions;
  std::size_t points;
  Vec3 lengths;
  int full_levels;  ///< lowest levels with more nodes than may be joined to one
};

std::ostream& operator<<(std::ostream& out, const DenseScene& scene) {
  return out << scene.points << " points in " << scene.dimensions << " dimensions";
}

class Packing : public ::testing::TestWithParam<DenseScene> {
 protected:
  std::vector<Vec3> points() const { return scenes::uniform(GetParam().points, GetParam().lengths, 5); }
};

TEST_P(Packing, EdgesAndChildrenOfEveryLevelStayWithinTheBound) {
  for (const EdgeRule rule : {EdgeRule::additive, EdgeRule::thesis}) {
    ListedHierarchy h(params_for_packing(rule));
    std::vector<Vec3> at = points();
    h.build(at, Box::none());
    ASSERT_GT(h.levels(), GetParam().full_levels);
    EXPECT_EQ(overfull_level(h, GetParam().dimensions), 0);
    for (std::int32_t id = 0; id < 100; ++id) h.remove(7 * id);
    for (std::int32_t id = 0; id < 100; ++id) h.insert(at[static_cast<std::size_t>(7 * id)]);
    EXPECT_EQ(overfull_level(h, GetParam().dimensions), 0) << "after removal and insertion";
  }
}

TEST_P(Packing, TheCheckSeesTooManyEdges) {
  for (int level = 1; level <= GetParam().full_levels; ++level) {
    ListedHierarchy h(params_for_packing(EdgeRule::additive));
    h.build(points(), Box::none());
    join_all(HierarchyTestAccess::impl(h), level);
    EXPECT_EQ(overfull_level(h, GetParam().dimensions), level);
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Packing,
                         ::testing::Values(DenseScene{1, 4000, {400, 0, 0}, 6},
                                           DenseScene{2, 10000, {40, 40, 0}, 3},
                                           DenseScene{3, 8000, {9, 9, 9}, 1}),
                         [](const auto& p) { return "D" + std::to_string(p.param.dimensions); });

/// Points so spaced along a line that all are nodes up to level `top`, whose separation they just keep.
std::vector<Vec3> line_spaced_for(int top, const StructureParams& params) {
  const double spacing = std::ldexp(params.radius / (2 * params.c), top - 1) * (1 + 1e-9);
  std::vector<Vec3> points;
  for (int k = 0; k < 64; ++k) points.push_back({spacing * k, 0, 0});
  return points;
}

// One edge more or less than there are nodes within rho_i would show.
TEST(PackingOfLines, TheBoundIsReached) {
  for (const EdgeRule rule : {EdgeRule::additive, EdgeRule::thesis})
    for (int level = 1; level <= 8; ++level) {
      const StructureParams params = params_for_packing(rule);
      ListedHierarchy h(params);
      h.build(line_spaced_for(level, params), Box::none());
      ASSERT_EQ(h.level(level).nodes, 64);
      EXPECT_EQ(static_cast<double>(h.level(level).max_degree),
                largest_degree(1, reach(h, level), separation(h, level)))
          << "stored, level " << level;
      EXPECT_EQ(static_cast<double>(h.neighbors(32, level).size()),
                largest_degree(1, h.level(level).edge_threshold, separation(h, level)))
          << "of the conflict graph, level " << level;
    }
}

// The thesis's form, (8 c + 1)^d - 1, is that of rho_i = 4 c R_{i-1}. Thresholds with room for motion are
// wider than that in the lowest levels, so it does not hold there.
TEST(PackingOfLines, TheThesisFormHoldsForTheThesisRule) {
  for (int level = 1; level <= 6; ++level) {
    const StructureParams params = params_for_packing(EdgeRule::thesis);
    ListedHierarchy h(params);
    h.build(line_spaced_for(level, params), Box::none());
    EXPECT_LE(static_cast<double>(h.neighbors(32, level).size()), 8 * params.c) << level;
  }
  const StructureParams params = params_for_packing(EdgeRule::additive);
  ListedHierarchy wider(params);
  wider.build(line_spaced_for(1, params), Box::none());
  EXPECT_GT(wider.level(1).edge_threshold, 4 * params.c * wider.level(0).covering_radius);
}

// Lemma 5.3.3 speaks of levels whose nodes are separated, which the points are not.
TEST(PackingOfLeaves, LevelOneHasAnyNumberOfChildren) {
  ListedHierarchy h(params_for_packing(EdgeRule::additive));
  h.build(scenes::uniform(400, {0.2, 0.2, 0.2}, 3), Box::none());
  EXPECT_EQ(most_children(h, 1), 400);
  EXPECT_GT(most_children(h, 1), kMaxChildren[3]);
}

}  // namespace
}  // namespace dch
