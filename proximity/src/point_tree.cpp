// SPDX-License-Identifier: MIT
#include <utility>

#include <dch/base/index_count.hpp>
#include <dch/proximity/point_tree.hpp>

#include "geometry/position_check.hpp"
#include "nested_nets.hpp"
#include "upper_nodes.hpp"

namespace dch {

PointTree::PointTree(const HierarchyView& view)
    : box_(view.box()),
      rounding_(detail::WrapError(view.box()).bound(view.structure().largest_reach)),
      base_radius_(view.structure().base_radius),
      positions_(view.structure().raw),
      is_present_(view.capacity(), false) {
  index_count(static_cast<std::int64_t>(view.size()), "points in a tree", "take fewer points",
              kMaxIndexCount / 2);
  detail::UpperNodes upper(view.structure());
  nodes_ = std::move(upper.nodes);
  ids_ = std::move(upper.ids);
  for (const std::int32_t id : ids_) is_present_[static_cast<std::size_t>(id)] = true;
  detail::NestedNets(box_, base_radius_, positions_, nodes_, ids_).complete();
}

bool PointTree::contains(std::int32_t id) const {
  return id >= 0 && static_cast<std::size_t>(id) < is_present_.size() &&
         is_present_[static_cast<std::size_t>(id)];
}

}  // namespace dch
