// SPDX-License-Identifier: MIT
//
// Neighbor lists: the level-0 edges of the conflict graph, which ListFinder enumerates.
#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

#include "hierarchy/structure.hpp"
#include "geometry/position_check.hpp"
#include "lists/list_check.hpp"

namespace dch {

using detail::with_metric;

double Hierarchy::Impl::prepare_for_lists() {
  const double wrap_error = detail::WrapError(box).bound(largest_reach);
  with_metric(box, [&](const auto& metric) {
    if (wrap_error > wrap_slack) {  // points inserted since the last update lie much farther out
      change_or_empty([&] {
        set_wrap_slack();
        refresh_centers(metric);
        repair(metric);
      });
    }
    measure(metric);
  });
  constexpr double kRoundings = 32;  // of relative positions
  return wrap_error + kRoundings * std::numeric_limits<double>::epsilon() * params.radius;
}

detail::ListSource Hierarchy::Impl::list_source(const detail::ParticleNames& names) {
  return {&levels, &points, &cluster_points, names, pending ? motion : 0.0};
}

void Hierarchy::Impl::lists(Span<const ListParams> requests, const std::vector<NeighborList*>& out) {
  const auto start = std::chrono::steady_clock::now();
  double reach = 0, host_error = 0;
  for (const ListParams& request : requests) {
    detail::check_list_params(request, raw.size(), params.radius);
    reach = std::max(reach, request.list_radius());
    host_error = std::max(host_error, request.cutoff_error());
  }
  detail::make_or_empty(out, [&] {
    const double error = prepare_for_lists() + host_error;
    const detail::ListScene scene{box,   {list_source({})}, {(reach + error) * (1 + 1e-12)},
                                  error, params.executor,   lone_points()};
    list_finder.find(scene, raw, requests, out);
  });
  stats.list_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Metric>
void Hierarchy::Impl::neighbors(const Metric& metric, int i, std::int32_t node,
                                std::vector<std::int32_t>& nodes) const {
  if (i > 0) {
    for (const std::int32_t other : levels[i].edges.row(node))
      if (i == 1 ||
          metric.distance2(levels[i].position[node], levels[i].position[other]) <= levels[i].threshold2)
        nodes.push_back(other);
    return;
  }
  const std::int32_t cluster = points.parent(node);
  const auto look_at_children = [&](std::int32_t parent) {
    for_each_child(1, parent, [&](std::int32_t other) {
      if (other != node &&
          metric.distance2(points.position[node], points.position[other]) <= levels[0].threshold2)
        nodes.push_back(other);
    });
  };
  look_at_children(cluster);
  for (const std::int32_t neighbor : levels[1].edges.row(cluster)) look_at_children(neighbor);
}

#define DCH_INSTANTIATE(Metric)                                                                          \
  template void Hierarchy::Impl::neighbors(const Metric&, int, std::int32_t, std::vector<std::int32_t>&) \
      const;
DCH_INSTANTIATE(detail::OpenMetric)
DCH_INSTANTIATE(detail::OrthorhombicMetric)
DCH_INSTANTIATE(detail::LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch
