// SPDX-License-Identifier: MIT
//
// Minimum spanning trees and the clusters in them, in all boxes and of hard point sets, against all pairs.
#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/spanning_tree.hpp>

#include "effort.hpp"
#include "proximity_checks.hpp"
#include "proximity_scene.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

/// The oracle's sets: each point names another one of its set, or itself.
class Sets {
 public:
  explicit Sets(std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) above_.push_back(k);
  }
  std::size_t of(std::size_t k) const { return above_[k] == k ? k : of(above_[k]); }
  void join(std::size_t a, std::size_t b) { above_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> above_;
};

/// Kruskal's algorithm over all pairs of some points.
std::vector<TreeEdge> all_pairs_tree(const HierarchyView& view, const std::vector<std::int32_t>& ids) {
  std::vector<TreeEdge> all, tree;
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (std::size_t j = i + 1; j < ids.size(); ++j)
      all.push_back({ids[i], ids[j], view.box().distance2(view.position(ids[i]), view.position(ids[j]))});
  std::sort(all.begin(), all.end());
  Sets sets(view.capacity());
  for (const TreeEdge& edge : all) {
    const auto a = static_cast<std::size_t>(edge.a), b = static_cast<std::size_t>(edge.b);
    if (sets.of(a) == sets.of(b)) continue;
    sets.join(a, b);
    tree.push_back(edge);
  }
  return tree;
}

void check_tree(const HierarchyView& view, const std::vector<std::int32_t>& ids, const std::string& what) {
  const SpanningTree tree = minimum_spanning_tree(view);
  const std::vector<TreeEdge> expected = all_pairs_tree(view, ids);
  ASSERT_EQ(tree.points.size(), ids.size()) << what;
  ASSERT_EQ(tree.edges.size(), expected.size()) << what;
  for (std::size_t e = 0; e < expected.size(); ++e)
    ASSERT_TRUE(!(tree.edges[e] < expected[e]) && !(expected[e] < tree.edges[e])) << what << ", edge " << e;
}

TEST(SpanningTreesThatChange, EqualThoseOfAllPairsInRandomScenes) {
  for (int k = 0; k < effort(200); ++k) {
    ProximityScene scene(9000000 + static_cast<std::uint64_t>(k), 120);
    for (int step = 0; step < 4; ++step) {
      ASSERT_NO_FATAL_FAILURE(check_spanning_tree(scene)) << "step " << step;
      scene.change(step);
    }
  }
}

class SpanningTrees : public testing::TestWithParam<scenes::NamedBox> {};

TEST_P(SpanningTrees, EqualThatOfAllPairsAlsoAfterMotion) {
  const Box& box = GetParam().box;
  for (const std::size_t n : {0, 1, 2, 7, 60, 300}) {
    for (const scenes::NamedPoints& set :
         scenes::hard_point_sets(box, static_cast<std::size_t>(effort(static_cast<int>(n))), 0.6)) {
      HierarchyParams params;
      params.radius = std::min(1.0, 0.9 * box.max_cutoff());
      Hierarchy hierarchy(params);
      std::vector<Vec3> points = set.points;
      hierarchy.build(points, box);
      scenes::Random random(n);
      for (int step = 0; step < 2; ++step) {
        std::vector<std::int32_t> ids(points.size());
        std::iota(ids.begin(), ids.end(), 0);
        ASSERT_NO_FATAL_FAILURE(check_tree(
            hierarchy.view(), ids,
            set.name + ", " + std::to_string(points.size()) + " points, step " + std::to_string(step)));
        for (Vec3& p : points) p = p + random.in_cube(0.05);
        hierarchy.update(points, box);
      }
    }
  }
}

TEST_P(SpanningTrees, HoldTheClustersAtEveryCutoff) {
  const Box& box = GetParam().box;
  const std::vector<Vec3> points = scenes::uniform_in(box, 200, 5);
  HierarchyParams params;
  params.radius = std::min(1.0, 0.9 * box.max_cutoff());
  Hierarchy hierarchy(params);
  hierarchy.build(points, box);
  const SpanningTree tree = minimum_spanning_tree(hierarchy.view());
  const std::vector<double> cutoffs{0, 0.1, 0.3, 0.5, 0.8, 1.5, 100};
  const std::vector<std::int64_t> counts = cluster_counts(tree, cutoffs);
  for (std::size_t c = 0; c < cutoffs.size(); ++c) {
    Sets sets(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (box.distance2(points[i], points[j]) <= cutoffs[c] * cutoffs[c]) sets.join(i, j);
    std::map<std::size_t, std::int64_t> size;
    for (std::size_t i = 0; i < points.size(); ++i) ++size[sets.of(i)];
    std::vector<std::int64_t> sizes;
    for (const auto& [set, members] : size) sizes.push_back(members);
    std::sort(sizes.rbegin(), sizes.rend());
    const Clusters clusters = clusters_at(tree, cutoffs[c]);
    EXPECT_EQ(clusters.sizes, sizes) << cutoffs[c];
    EXPECT_EQ(counts[c], static_cast<std::int64_t>(sizes.size())) << cutoffs[c];
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto label = static_cast<std::size_t>(clusters.label[i]);
      EXPECT_LE(label, i);
      EXPECT_EQ(sets.of(label), sets.of(i)) << cutoffs[c];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, SpanningTrees, testing::ValuesIn(scenes::all_boxes(6)),
                         [](const auto& box) { return box.param.name; });

}  // namespace

void check_spanning_tree(ProximityScene& scene) { check_tree(scene.view(), scene.ids(), scene.what()); }

}  // namespace dch
