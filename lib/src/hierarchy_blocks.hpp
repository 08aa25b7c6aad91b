// SPDX-License-Identifier: MIT
#pragma once

#include "hierarchy_impl.hpp"

namespace dch {

template <class IdOf, class PositionOf>
void Hierarchy::Impl::fill_cluster(detail::PointBlocks& blocks, std::int32_t cluster,
                                   std::vector<detail::LocalPoint>& local, const IdOf& id_of,
                                   const PositionOf& position_of) {
  const auto count = static_cast<std::int32_t>(local.size());
  const std::int32_t parts = detail::blocks_for(count);
  detail::order_by_halving(local.data(), count);
  std::int32_t last = detail::kNone, k = 0;
  for (std::int32_t part = 0; part < parts; ++part) {
    const std::int32_t block = blocks.add_block(cluster, detail::kNone);
    (last == detail::kNone ? levels[1].first_child[cluster] : blocks.next[last]) = block;
    last = block;
    for (; k < detail::share_of_blocks(count, parts, part + 1); ++k) {
      const std::int32_t id = id_of(local[k].index);
      slot_of_id[id] = blocks.push(block, id, position_of(local[k].index));
      if (id == levels[1].id[cluster]) levels[1].down[cluster] = slot_of_id[id];
    }
  }
}

}  // namespace dch
