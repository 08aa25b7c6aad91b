// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <type_traits>
#include <vector>

#include <dch/clusters/cluster_pairs.hpp>

#include "clusters/cluster_pair_finder.hpp"
#include "geometry/metric.hpp"

namespace dch::detail {

/// Nodes with points around them, joined as a test says, for the finder of cluster pairs to search: scenes
/// with nothing in them that a hierarchy would add, at distances that are exact.
class HandMadeNodes {
 public:
  explicit HandMadeNodes(const Box& box = Box::none()) : box_(box) {}

  /// A node with a point at each of these places relative to it.
  std::int32_t add(Vec3 center, const std::vector<Vec3>& around = {{}}) {
    const std::int32_t node = nodes.add(0, center);
    for (const Vec3 p : around) {
      std::int32_t& block = nodes.first_child[static_cast<std::size_t>(node)];
      if (block == kNone || points.count[static_cast<std::size_t>(block)] == kBlock) {
        std::int32_t added = points.add_block(node);
        points.append(added, block);
        block = added;
      }
      points.push(block, static_cast<std::int32_t>(positions.size()), center + p);
      positions.push_back(center + p);
    }
    return node;
  }
  void join(std::int32_t a, std::int32_t b) {
    nodes.edges.push(a, b);
    nodes.edges.push(b, a);
  }

  /// @param reach within which points are a pair [length]
  const ClusterPairs& find(double reach, Executor* executor = nullptr) {
    with_metric(box_, [&](const auto& metric) {
      using Scene = ClusterPairFinder::Scene<std::decay_t<decltype(metric)>>;
      leaves.forget_layout();
      leaves.measure(metric, nodes, points, 1, nullptr);
      finder.find(Scene{metric, box_, nodes, points, leaves, positions, request, reach}, executor, pairs);
    });
    return pairs;
  }
  ClusterPairFinder::Work work_of(double reach) {
    find(reach);
    return finder.work();
  }

  Level nodes;
  LeafBlocks points;
  MeasuredLeaves leaves;
  std::vector<Vec3> positions;
  ListParams request;
  ClusterPairFinder finder;
  ClusterPairs pairs;

 private:
  Box box_;
};

/// An executor of one thread that says it has some, and what it was asked for.
class CountedParts : public Executor {
 public:
  explicit CountedParts(int threads) : threads_(threads) {}
  int threads() const override { return threads_; }
  void run(int parts, const std::function<void(int)>& task) override {
    asked.push_back(parts);
    for (int part = 0; part < parts; ++part) task(part);
  }
  std::vector<int> asked;

 private:
  int threads_;
};

}  // namespace dch::detail
