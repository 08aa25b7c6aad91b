// SPDX-License-Identifier: MIT
//
// Queries of trees of points and neighbors at any radius hold nothing when memory did not suffice, and give
// the same answer as ever when asked again.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/closest_pair.hpp>
#include <dch/proximity/far_sums.hpp>
#include <dch/proximity/k_center.hpp>
#include <dch/proximity/neighbors_within.hpp>
#include <dch/proximity/point_tree.hpp>
#include <dch/proximity/spanner.hpp>
#include <dch/proximity/well_separated_pairs.hpp>

#include "scene.hpp"

namespace dch::faults {
namespace {

/// Numbers that tell answers apart.
using Answer = std::vector<double>;

Hierarchy small_hierarchy() {
  const Scene scene(60);
  Hierarchy hierarchy(params_for());
  hierarchy.build(scene.points, scene.box);
  return hierarchy;
}

/// Has a query fail at each of its allocations.
/// @param query as query(subject), returns an Answer
template <class Subject, class Query>
void sweep_query(const Subject& subject, const Query& query) {
  const Answer expected = query(subject);
  const SweepResult result = sweep([&] { return Answer(); }, [&](Answer& answer) { answer = query(subject); },
                                   [&](Answer& answer, Ending ending) -> std::string {
                                     if (ending == Ending::threw) answer = query(subject);
                                     return answer == expected ? "" : after(ending, "another answer");
                                   });
  expect_sound(result, 5);
}

TEST(ProximityFaults, Trees) {
  Hierarchy hierarchy = small_hierarchy();
  sweep_query(hierarchy.view(), [](const HierarchyView& view) {
    const PointTree tree(view);
    Answer answer(tree.ids().begin(), tree.ids().end());
    for (const PointTree::Node& node : tree.nodes()) answer.push_back(node.radius);
    return answer;
  });
}

TEST(ProximityFaults, QueriesOfTrees) {
  Hierarchy hierarchy = small_hierarchy();
  const PointTree tree(hierarchy.view());
  sweep_query(tree, [](const PointTree& of) {
    Answer answer;
    for (const WellSeparatedPair& pair : well_separated_pairs(of, 1).pairs) {
      answer.push_back(pair.a);
      answer.push_back(pair.b);
    }
    return answer;
  });
  sweep_query(tree, [](const PointTree& of) {
    const Spanner spanner(of, 2);
    return Answer{spanner.weight(), spanner.shortest_path(3, 40).length};
  });
  sweep_query(tree, [](const PointTree& of) {
    return k_centers(of, std::vector<std::int64_t>{2, 9, 30}).radius;
  });
  sweep_query(tree, [](const PointTree& of) { return Answer{closest_pair(of).distance2}; });
  sweep_query(tree, [](const PointTree& of) {
    FarSumParams params;
    params.kappa = 8;
    return far_sums(of, Answer(of.capacity(), 1.0), params).potentials;
  });
}

TEST(ProximityFaults, NeighborsAtAnyRadius) {
  Hierarchy hierarchy = small_hierarchy();
  sweep_query(hierarchy.view(), [](const HierarchyView& view) {
    return NeighborsWithin(view).of_points(std::vector<std::int32_t>{1, 2, 3}, 1.2).distance2;
  });
}

}  // namespace
}  // namespace dch::faults
