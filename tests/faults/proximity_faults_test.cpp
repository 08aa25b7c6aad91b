// SPDX-License-Identifier: MIT
//
// Queries of trees of points, neighbors at any radius, nearest neighbors and spanning trees hold nothing when
// memory did not suffice, and give the same answer as ever when asked again.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/closest_pair.hpp>
#include <dch/proximity/far_sums.hpp>
#include <dch/proximity/k_center.hpp>
#include <dch/proximity/kept_nearest.hpp>
#include <dch/proximity/nearest.hpp>
#include <dch/proximity/neighbors_within.hpp>
#include <dch/proximity/point_tree.hpp>
#include <dch/proximity/spanner.hpp>
#include <dch/proximity/spanning_tree.hpp>
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

/// A tree that has thrown is empty, and the next update makes it right, whatever ids it is told.
TEST(ProximityFaults, TreesThatAreKeptUp) {
  struct Subject {
    Hierarchy hierarchy{params_for()};
    std::optional<PointTree> tree;
  };
  const Scene scene(60);
  const std::vector<std::int32_t> changed{7, 60}, none;
  for (const bool is_told : {true, false}) {
    const auto make = [&] {
      auto subject = std::make_unique<Subject>();
      subject->hierarchy.build(scene.points, scene.box);
      subject->tree.emplace(subject->hierarchy.view());
      subject->hierarchy.remove(7);
      subject->hierarchy.insert({0.1, 0.2, 0.3});
      subject->hierarchy.insert({0.1, 0.2, 0.4});
      subject->hierarchy.view();
      return subject;
    };
    const auto update = [&](auto& subject) {
      if (is_told) return subject->tree->update(subject->hierarchy.view(), changed);
      subject->tree->update(subject->hierarchy.view());
    };
    const auto answer_of = [](const PointTree& tree) {
      const ClosestPoints closest = closest_pair(tree);
      Answer answer(tree.ids().begin(), tree.ids().end());
      std::sort(answer.begin(), answer.end());
      answer.insert(answer.end(), {closest.a + 0.0, closest.b + 0.0, closest.distance2});
      return answer;
    };
    const auto expected = make();
    update(expected);
    EXPECT_EQ(expected->tree->work().builds, 1);
    expect_sound(sweep(make, update,
                       [&](auto& subject, Ending ending) -> std::string {
                         if (ending == Ending::threw && subject->tree->size() > 0)
                           return after(ending, "points in a tree that threw");
                         if (ending == Ending::threw) subject->tree->update(subject->hierarchy.view(), none);
                         return answer_of(*subject->tree) == answer_of(*expected->tree)
                                    ? ""
                                    : after(ending, "another answer");
                       }),
                 5);
  }
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

Answer answer_of(const NearestRows& rows) {
  Answer answer = rows.distance2;
  answer.insert(answer.end(), rows.id.begin(), rows.id.end());
  return answer;
}

void sweep_nearest(const HierarchyView& view, Executor* executor) {
  NearestParams params;
  params.k = 3;
  params.executor = executor;
  sweep_query(view, [&](const HierarchyView& of) { return answer_of(Nearest(of).of_points(params)); });
  const Scene others(20, 9);
  sweep_query(view, [&](const HierarchyView& of) {
    return answer_of(Nearest(of).of_positions(others.points, params));
  });
}

TEST(ProximityFaults, NearestNeighbors) {
  Hierarchy hierarchy = small_hierarchy();
  sweep_nearest(hierarchy.view(), nullptr);
  sweep_nearest(hierarchy.kept_view(), nullptr);
}

TEST(ProximityFaults, NearestNeighborsOnThreads) {
  const auto pool = make_thread_pool(3);
  Hierarchy hierarchy = small_hierarchy();
  sweep_nearest(hierarchy.view(), pool.get());
}

/// By a grid and by descent, after points have come and gone.
TEST(ProximityFaults, NearestNeighborsThatAreKept) {
  struct Subject {
    Hierarchy hierarchy{params_for()};
    KeptNearest kept;
    Answer answer;
  };
  const Scene scene(60), others(20, 9);
  const auto make = [&] {
    auto subject = std::make_unique<Subject>();
    subject->hierarchy.build(scene.points, Box::none());
    subject->kept.update(subject->hierarchy.kept_view());
    subject->hierarchy.remove(7);
    subject->hierarchy.insert({0.1, 0.2, 0.3});
    for (int k = 0; k < 30; ++k) subject->hierarchy.insert({0.1, 0.2, 0.4});
    subject->hierarchy.kept_view();
    return subject;
  };
  const auto ask = [&](auto& subject) {
    subject->kept.update(subject->hierarchy.kept_view(), std::vector<std::int32_t>{7});
    subject->answer = answer_of(subject->kept.of_positions(others.points, {3}));
  };
  const auto expected = make();
  ask(expected);
  EXPECT_GE(expected->kept.work().by_grid, 1);
  EXPECT_GE(expected->kept.work().descents, 1);
  expect_sound(sweep(make, ask,
                     [&](auto& subject, Ending ending) -> std::string {
                       if (ending == Ending::threw)
                         subject->answer = answer_of(subject->kept.of_positions(others.points, {3}));
                       return subject->answer == expected->answer ? "" : after(ending, "another answer");
                     }),
               5);
}

TEST(ProximityFaults, SpanningTreesAndTheirClusters) {
  const auto pool = make_thread_pool(2);
  Hierarchy hierarchy = small_hierarchy();
  for (Executor* executor : {static_cast<Executor*>(nullptr), pool.get()})
    sweep_query(hierarchy.view(), [&](const HierarchyView& view) {
      Answer answer;
      for (const TreeEdge& edge : minimum_spanning_tree(view, executor).edges)
        answer.insert(answer.end(), {edge.a + 0.0, edge.b + 0.0, edge.distance2});
      return answer;
    });
  const SpanningTree whole = minimum_spanning_tree(hierarchy.view());
  const SweepResult result =
      sweep([] { return Clusters(); }, [&](Clusters& clusters) { clusters = clusters_at(whole, 0.8); },
            [&](Clusters& clusters, Ending ending) -> std::string {
              if (ending == Ending::threw) clusters = clusters_at(whole, 0.8);
              return clusters.sizes == clusters_at(whole, 0.8).sizes ? "" : after(ending, "other clusters");
            });
  expect_sound(result, 3);
}

}  // namespace
}  // namespace dch::faults
