// SPDX-License-Identifier: MIT
#include "home_search.hpp"

#include "geometry/metric.hpp"
#include "geometry/tolerance.hpp"
#include "hierarchy/structure.hpp"

namespace dch::kinetic {
namespace {

using detail::kInflate;
using detail::Structure;

/// Descents rely on parents that cover where they are now, so no repair is put off.
HierarchyParams hierarchy_for(double radius) {
  HierarchyParams params;
  params.radius = radius;
  params.policy = MaintenancePolicy::always_repair;
  return params;
}

/// The points below a node of level i are within R_0 + ... + R_{i-1} of it, those of a leaf within R_0.
template <class Metric, class F>
class Descent {
 public:
  Descent(const Metric& metric, const Structure& structure, Vec3 at, double reach, const F& f)
      : metric_(metric), structure_(structure), at_(metric.wrap(at)), reach_(reach * kInflate), f_(f) {
    double below = reach_ + structure.wrap_slack;
    for (int level = 0; level < structure.top(); ++level) below += radius(level);
    const detail::Level& top = structure.levels.back();
    for (std::int32_t root = 0; root < top.size(); ++root)
      if (top.is_alive(root)) visit(structure.top(), root, below);
  }

 private:
  double radius(int level) const { return structure_.levels[level].radius * kInflate; }
  void visit(int level, std::int32_t node, double reach) {
    if (metric_.distance2(at_, structure_.position(level, node)) > reach * reach) return;
    if (level == 0) return f_(structure_.points.id[node]);
    if (structure_.is_singleton(level, node)) f_(structure_.levels[level].id[node]);
    structure_.for_each_child(
        level, node, [&](std::int32_t child) { visit(level - 1, child, reach - radius(level - 1)); });
  }

  const Metric& metric_;
  const Structure& structure_;
  Vec3 at_;
  double reach_;
  const F& f_;
};

}  // namespace

HomeSearch::HomeSearch(const KineticParams& params, double largest, double room)
    : params_(params), hierarchy_(hierarchy_for((largest + room) * kInflate)) {
  request_.cutoffs = TypeCutoffs(largest);
  request_.radii = params_.radii;
  request_.skin = room;
}

const NeighborList& HomeSearch::find_all(Span<const Vec3> homes) {
  if (is_built_) {
    hierarchy_.update(homes, params_.box);
  } else {
    hierarchy_.build(homes, params_.box);
  }
  is_built_ = true;
  maker_.list(hierarchy_.view(), request_, list_);
  return list_;
}

void HomeSearch::find_near(Vec3 position, double reach, const std::function<void(std::int32_t)>& f) {
  const Structure& structure = hierarchy_.view().structure();
  detail::with_metric(params_.box,
                      [&](const auto& metric) { Descent(metric, structure, position, reach, f); });
}

}  // namespace dch::kinetic
