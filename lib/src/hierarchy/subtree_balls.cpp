// SPDX-License-Identifier: MIT
#include "hierarchy/subtree_balls.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/metric.hpp"
#include "geometry/tolerance.hpp"
#include "hierarchy/structure.hpp"

namespace dch::detail {

SubtreeBalls::SubtreeBalls(const Structure& structure) : levels_(structure.levels.size()) {
  for (int level = 1; level <= structure.top(); ++level) {
    const auto nodes = static_cast<std::size_t>(structure.levels[level].size());
    levels_[level].radius.assign(nodes, 0);
    levels_[level].count.assign(nodes, 0);
  }
  measure_leaves(structure);
  with_metric(structure.box, [&](const auto& metric) {
    for (int level = 2; level <= structure.top(); ++level) measure_level(metric, structure, level);
  });
}

void SubtreeBalls::measure_leaves(const Structure& structure) {
  const MeasuredLeaves& measured = structure.leaves;
  for (std::int32_t k = 0; k < structure.levels[1].size(); ++k) {
    const MeasuredLeaves::Leaf& leaf = measured.leaves[k];
    levels_[1].radius[k] = leaf.extent * kInflate;
    boxes_.add_leaf(k);
    for (std::int32_t b = leaf.first_block; b < leaf.first_block + leaf.blocks; ++b) {
      levels_[1].count[k] += measured.count[b];
      boxes_.add(k, measured.source[b], measured.corners[b]);
    }
  }
}

/// While a repair is put off, nodes of the upper levels are where they were before, and so is a singleton,
/// whose point may have moved away from it.
template <class Metric>
void SubtreeBalls::measure_level(const Metric& metric, const Structure& structure, int level) {
  const Level& at = structure.levels[level];
  for (std::int32_t k = 0; k < at.size(); ++k) {
    if (!at.is_alive(k)) continue;
    double radius = 0;
    std::int64_t count = 0;
    if (structure.is_singleton(level, k)) {
      radius = std::sqrt(metric.distance2(at.position[k], metric.wrap(structure.raw[at.id[k]])));
      count = 1;
    }
    structure.for_each_child(level, k, [&](std::int32_t child) {
      const double apart = std::sqrt(metric.distance2(at.position[k], structure.position(level - 1, child)));
      radius = std::max(radius, apart + levels_[level - 1].radius[child]);
      count += levels_[level - 1].count[child];
    });
    levels_[level].radius[k] = radius * kInflate;
    levels_[level].count[k] = count;
  }
}

/// A number of a node may be that of one that went.
void SubtreeBalls::add_node(int level, std::int32_t node) {
  const auto at = static_cast<std::size_t>(level), k = static_cast<std::size_t>(node);
  levels_.resize(std::max(levels_.size(), at + 1));
  levels_[at].radius.resize(std::max(levels_[at].radius.size(), k + 1));
  levels_[at].radius[k] = 0;
  if (level == 1) boxes_.add_leaf(node);
}

void SubtreeBalls::add_point(const Structure& structure, std::int32_t slot) {
  const std::int32_t leaf = structure.points.parent(slot);
  with_metric(structure.box, [&](const auto& metric) {
    const Vec3 at = structure.position_in(slot, metric);
    const Vec3 offset = metric.displacement(structure.levels[1].position[leaf], at);
    const auto x = static_cast<float>(offset.x), y = static_cast<float>(offset.y),
               z = static_cast<float>(offset.z);
    const float corner[3] = {x, y, z};
    if (slot % kBlock == 0) {  // the first one of a block
      boxes_.add(leaf, slot / kBlock, {{x, y, z}, {x, y, z}});
    } else {
      boxes_.widen(slot / kBlock, corner);
    }
    widen_above(metric, structure, 1, leaf, at, 0);
  });
}

void SubtreeBalls::add_block(const Structure& structure, std::int32_t block) {
  for (std::int32_t lane = 0; lane < structure.points.count[block]; ++lane)
    add_point(structure, block * kBlock + lane);
}

void SubtreeBalls::add_subtree(const Structure& structure, int level, std::int32_t node) {
  with_metric(structure.box, [&](const auto& metric) {
    widen_above(metric, structure, level + 1, structure.parent(level, node), structure.position(level, node),
                radius(level, node));
  });
}

/// No point of a subtree is farther from its node than R_0 + R_1 + ... of the levels below.
template <class Metric>
void SubtreeBalls::widen_above(const Metric& metric, const Structure& structure, int level, std::int32_t node,
                               Vec3 at, double radius) {
  for (; node != kNone; node = structure.levels[level++].parent[node]) {
    const Level& above = structure.levels[level];
    const double apart = std::sqrt(metric.distance2(at, above.position[node]));
    const double most = above.radius - structure.levels[0].radius;
    double& ball = levels_[level].radius[node];
    ball = std::max(ball, std::min(apart + radius, most) * kInflate);
  }
}

std::size_t SubtreeBalls::memory_bytes() const {
  std::size_t bytes = boxes_.memory_bytes();
  for (const Balls& level : levels_)
    bytes += level.radius.capacity() * sizeof(double) + level.count.capacity() * sizeof(std::int64_t);
  return bytes;
}

}  // namespace dch::detail
