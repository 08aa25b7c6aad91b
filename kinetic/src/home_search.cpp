// SPDX-License-Identifier: MIT
#include "home_search.hpp"

#include "geometry/tolerance.hpp"
#include "hierarchy_descent.hpp"

namespace dch::kinetic {
namespace {

using detail::kInflate;

/// Descents rely on parents that cover where they are now, so no repair is put off.
HierarchyParams hierarchy_for(double radius) {
  HierarchyParams params;
  params.radius = radius;
  params.policy = MaintenancePolicy::always_repair;
  return params;
}

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
  for_each_near(hierarchy_.kept_view(), position, reach, f);
}

}  // namespace dch::kinetic
