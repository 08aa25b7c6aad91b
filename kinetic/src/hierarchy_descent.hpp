// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

#include <dch/base/vec3.hpp>
#include <dch/hierarchy/hierarchy.hpp>

#include "geometry/metric.hpp"
#include "geometry/tolerance.hpp"
#include "hierarchy/structure.hpp"

namespace dch::kinetic {

/// Calls f(id) for all points of a hierarchy that are within `reach` of a position, to within rounding: by
/// the measured balls of its nodes and the boxes around blocks of points.
template <class Metric, class F>
class HierarchyDescent {
 public:
  /// @param view a kept_view()
  HierarchyDescent(const Metric& metric, const HierarchyView& view, Vec3 at, double reach, const F& f)
      : metric_(metric),
        structure_(view.structure()),
        at_(metric.wrap(at)),
        reach_((reach + structure_.wrap_slack) * detail::kInflate),
        f_(f) {
    const detail::Level& top = structure_.levels.back();
    for (std::int32_t root = 0; root < top.size(); ++root)
      if (top.is_alive(root)) visit(structure_.top(), root);
  }

 private:
  void visit(int level, std::int32_t node) {
    const detail::Level& nodes = structure_.levels[level];
    const double extent = structure_.balls->radius(level, node) * detail::kInflate;
    const Vec3 off = metric_.displacement(nodes.position[node], at_);
    if (norm2(off) > (reach_ + extent) * (reach_ + extent)) return;
    if (level == 1) return look_at_leaf(node, off, extent);
    if (structure_.is_singleton(level, node)) look_at(nodes.id[node], nodes.position[node]);
    for (std::int32_t child = nodes.first_child[node]; child != detail::kNone;
         child = structure_.levels[level - 1].next_sibling[child])
      visit(level - 1, child);
  }

  /// @param off of the position from the center of the leaf
  void look_at_leaf(std::int32_t node, Vec3 off, double extent) {
    const detail::LeafBlocks& points = structure_.points;
    // Boxes say nothing where another image of one may be as near.
    const bool has_one_image = (reach_ + extent) * detail::kInflate < structure_.box.max_cutoff();
    const float most2 = has_one_image ? detail::BlockBoxes::most_gap2(off, extent, reach_)
                                      : std::numeric_limits<float>::infinity();
    structure_.balls->boxes().for_each_within(node, off, most2, [&](std::int32_t block, float) {
      const std::int32_t first = block * detail::kBlock, last = first + points.count[block];
      for (std::int32_t slot = first; slot < last; ++slot) look_at(points.id[slot], points.position[slot]);
    });
  }
  void look_at(std::int32_t id, Vec3 position) {
    if (metric_.distance2(at_, position) <= reach_ * reach_) f_(id);
  }

  const Metric& metric_;
  const detail::Structure& structure_;
  Vec3 at_;
  double reach_;
  const F& f_;
};

/// The same, whatever the box. @param view a kept_view()
template <class F>
void for_each_near(const HierarchyView& view, Vec3 at, double reach, const F& f) {
  detail::with_metric(view.box(), [&](const auto& metric) { HierarchyDescent(metric, view, at, reach, f); });
}

}  // namespace dch::kinetic
