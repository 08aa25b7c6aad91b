// SPDX-License-Identifier: MIT
//
// Points in their final order: by leaf, close together in blocks.
#pragma once

#include <algorithm>

#include "hierarchy/hierarchy_impl.hpp"

namespace dch {

template <class Metric, class IdOf, class PositionOf>
void Hierarchy::Impl::fill_leaves(const Metric& metric, detail::LeafBlocks& blocks,
                                  std::vector<std::int32_t>& leaf_of, const IdOf& id_of,
                                  const PositionOf& position_of) {
  Members members;
  members.sort(leaf_of, levels[1].size());
  choose_nearest(metric, members, leaf_of, position_of);
  members.sort(leaf_of, levels[1].size());
  std::int64_t most = 0;
  for (std::int32_t k = 0; k < levels[1].size(); ++k)
    most += detail::blocks_for(members.first[k + 1] - members.first[k]);
  blocks.reserve(detail::block_count(most, blocks.most));
  std::vector<detail::LocalPoint> local;
  for (std::int32_t k = 0; k < levels[1].size(); ++k) {
    local.clear();
    for (std::int32_t m = members.first[k]; m < members.first[k + 1]; ++m) {
      const std::int32_t index = members.index[m];
      const Vec3 at = metric.displacement(levels[1].position[k], position_of(index));
      local.push_back(detail::local_point(at, index));
    }
    fill_leaf(blocks, k, local, id_of, position_of);
  }
}

/// A point takes the nearest center in the place of another one that covers it: leaves become compact. A
/// center as near as the one of now is within twice that distance of it, and joined to it.
template <class Metric, class PositionOf>
void Hierarchy::Impl::choose_nearest(const Metric& metric, const Members& members,
                                     std::vector<std::int32_t>& leaf_of, const PositionOf& position_of) {
  struct Center {
    Vec3 at;  ///< relative to that of the leaf
    double distance2;
    std::int32_t node;
  };
  const Level& centers = levels[1];
  std::int64_t tested = 2 * static_cast<std::int64_t>(members.index.size()) + centers.edges.entries();
  std::vector<Center> others;
  for (std::int32_t k = 0; k < centers.size(); ++k) {
    others.clear();
    for (const std::int32_t node : centers.edges.row(k)) {
      const Vec3 at = metric.displacement(centers.position[k], centers.position[node]);
      if (norm2(at) < 4 * levels[0].radius2) others.push_back({at, norm2(at), node});
    }
    std::sort(others.begin(), others.end(), [](const Center& a, const Center& b) {
      return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.node < b.node;
    });
    for (std::int32_t m = members.first[k]; m < members.first[k + 1]; ++m) {
      const Vec3 position = position_of(members.index[m]);
      const Vec3 at = metric.displacement(centers.position[k], position);
      double least = norm2(at);
      std::int32_t nearest = k;
      for (const Center& other : others) {
        if (other.distance2 >= 4 * least) break;
        ++tested;
        const double distance2 = norm2(at - other.at);
        if (distance2 >= least) continue;
        least = distance2;
        nearest = other.node;
      }
      if (metric.distance2(position, centers.position[nearest]) <= levels[0].radius2)
        leaf_of[members.index[m]] = nearest;
    }
  }
  stats.distances += tested;
}

template <class IdOf, class PositionOf>
void Hierarchy::Impl::fill_leaf(detail::LeafBlocks& blocks, std::int32_t leaf,
                                std::vector<detail::LocalPoint>& local, const IdOf& id_of,
                                const PositionOf& position_of) {
  const auto count = static_cast<std::int32_t>(local.size());
  const std::int32_t parts = detail::blocks_for(count);
  detail::order_by_halving(local.data(), count);
  std::int32_t& chain = levels[1].first_child[leaf];
  std::int32_t k = 0;
  chain = detail::kNone;
  for (std::int32_t part = 0; part < parts; ++part) {
    const std::int32_t block = blocks.add_block(leaf);
    blocks.append(chain, block);
    for (; k < detail::share_of_blocks(count, parts, part + 1); ++k) {
      const std::int32_t id = id_of(local[k].index);
      slot_of_id[id] = blocks.push(block, id, position_of(local[k].index));
      if (id == levels[1].id[leaf]) levels[1].down[leaf] = slot_of_id[id];
    }
  }
}

}  // namespace dch
