// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/vec3.hpp>

#include "geometry/tolerance.hpp"
#include "hierarchy/structure.hpp"

namespace dch::kinetic {

/// Calls f(id) for the points of a hierarchy, with no repair put off, that are within `reach` of a position.
/// The points below a node of level i are within R_0 + ... + R_{i-1} of it, those of a leaf within R_0.
template <class Metric, class F>
class HierarchyDescent {
 public:
  HierarchyDescent(const Metric& metric, const detail::Structure& structure, Vec3 at, double reach,
                   const F& f)
      : metric_(metric),
        structure_(structure),
        at_(metric.wrap(at)),
        reach_(reach * detail::kInflate),
        f_(f) {
    double below = reach_ + structure.wrap_slack;
    for (int level = 0; level < structure.top(); ++level) below += radius(level);
    const detail::Level& top = structure.levels.back();
    for (std::int32_t root = 0; root < top.size(); ++root)
      if (top.is_alive(root)) visit(structure.top(), root, below);
  }

 private:
  double radius(int level) const { return structure_.levels[level].radius * detail::kInflate; }
  void visit(int level, std::int32_t node, double reach) {
    if (metric_.distance2(at_, structure_.position(level, node)) > reach * reach) return;
    if (level == 0) return f_(structure_.points.id[node]);
    if (structure_.is_singleton(level, node)) f_(structure_.levels[level].id[node]);
    structure_.for_each_child(
        level, node, [&](std::int32_t child) { visit(level - 1, child, reach - radius(level - 1)); });
  }

  const Metric& metric_;
  const detail::Structure& structure_;
  Vec3 at_;
  double reach_;
  const F& f_;
};

}  // namespace dch::kinetic
