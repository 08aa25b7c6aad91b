// SPDX-License-Identifier: MIT
//
// New positions: taken over and measured in one pass, and what is done then: nothing while the edges are
// certified to be enough for lists, else a repair or a new build, whichever is cheaper by the structure's own
// timings.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "hierarchy_impl.hpp"
#include "position_check.hpp"
#include "seconds_since.hpp"

namespace dch {

using detail::kNone;
using detail::Level;
using detail::seconds_since;
using detail::with_metric;
using Clock = std::chrono::steady_clock;

void Hierarchy::Impl::update(Span<const Vec3> positions, const Box& b) {
  ++stats.updates;
  const auto start = Clock::now();
  try {
    largest_reach = check_positions_of_points(positions, b);
    detail::check_radius(params.radius, b);
    const bool fresh = stats.builds == 0;
    if (fresh || (params.policy == MaintenancePolicy::always_rebuild && free_ids.empty())) {
      build(positions, b);
    } else {
      const bool same_box = box == b;
      box = b;
      for (Level& level : levels) level.complete = same_box ? level.complete : 0;
      if (!pending) anchors = levels[1].position;
      raw.assign(positions.begin(), positions.end());
      with_metric(box, [&](const auto& metric) {
        refresh_clusters(metric);
        if (params.policy == MaintenancePolicy::automatic && same_box && edges_are_certified(metric)) {
          pending = true;
          ++stats.refreshes;
          return;
        }
        set_wrap_slack();
        refresh_centers(metric);
        const auto counting = Clock::now();
        const std::int64_t orphans = count_orphans(metric);
        const double check_seconds = seconds_since(counting);
        if (params.policy != MaintenancePolicy::always_repair && free_ids.empty() && !repair_pays(orphans)) {
          build(positions, b);
          per_orphan.fade();
        } else {
          repair(metric, check_seconds);
        }
      });
    }
  } catch (...) {
    reset(Box());
    throw;
  }
  stats.maintain_seconds += seconds_since(start);
}

double Hierarchy::Impl::check_positions_of_points(Span<const Vec3> positions, const Box& b) const {
  if (free_ids.empty()) return detail::check_positions(positions, b);
  std::vector<Vec3> live(positions.begin(), positions.end());
  for (std::size_t id = 0; id < live.size(); ++id)
    if (slot_of_id[id] == kNone) live[id] = b.origin();
  return detail::check_positions(live, b);
}

template <class Metric>
void Hierarchy::Impl::refresh_level(const Metric& metric, int i) {
  Level& level = levels[i];
  double moved2 = 0;
  for (std::int32_t k = 0; k < level.size(); ++k) {
    if (!level.is_alive(k)) continue;
    const Vec3 at = metric.wrap(raw[level.id[k]]);
    moved2 = std::max(moved2, metric.distance2(level.position[k], at));
    level.position[k] = at;
  }
  level.moved += std::sqrt(moved2) * kInflate;
}

template <class Metric>
void Hierarchy::Impl::refresh_clusters(const Metric& metric) {
  refresh_level(metric, 1);
  cluster_points.refresh(metric, levels[1], raw, points, levels[0].radius2, params.executor);
  measured = true;
}

template <class Metric>
void Hierarchy::Impl::refresh_centers(const Metric& metric) {
  for (int i = 2; i <= top(); ++i) refresh_level(metric, i);
}

template <class Metric>
std::int64_t Hierarchy::Impl::count_orphans(const Metric& metric) const {
  std::int64_t count = 0;
  for (const auto& cluster : cluster_points.clusters) count += cluster.uncovered;
  for (int i = 2; i <= top(); ++i) {
    const double limit2 = levels[i - 1].radius2;
    for (std::int32_t k = 0; k < levels[i].size(); ++k) {
      if (!levels[i].is_alive(k)) continue;
      const Vec3 center = levels[i].position[k];
      for_each_child(i, k, [&](std::int32_t child) {
        count += metric.distance2(position(i - 1, child), center) > limit2;
      });
    }
  }
  return count;
}

template <class Metric>
void Hierarchy::Impl::measure(const Metric& metric) {
  if (!measured) cluster_points.measure(metric, levels[1], points, levels[0].radius2, params.executor);
  measured = true;
}

// Two clusters without an edge were more than rho_1 apart when the structure was in order, so now they are
// more than rho_1 minus both displacements apart, and their points more than that minus both extents: more
// than rho_0 if extent plus displacement is at most (rho_1 - rho_0) / 2 for every cluster. Lone nodes count
// as clusters; one of level i was more than rho_1 + R_i - R_1 away from the clusters of all others.
template <class Metric>
bool Hierarchy::Impl::edges_are_certified(const Metric& metric) {
  if (detail::WrapError(box).bound(largest_reach) > wrap_slack) return false;
  measure(metric);
  const double limit = 0.5 * (levels[1].threshold - wrap_slack - params.radius) / kInflate;
  motion = 0;
  for (std::int32_t k = 0; k < levels[1].size(); ++k) {
    if (!levels[1].is_alive(k)) continue;
    const double moved = std::sqrt(metric.distance2(anchors[k], levels[1].position[k]));
    if (cluster_points.clusters[k].extent + moved > limit) return false;
    motion = std::max(motion, moved);
  }
  for (const LoneNode& node : lone) {
    const Level& level = levels[node.level];
    const double moved =
        std::sqrt(metric.distance2(level.position[node.node], metric.wrap(raw[level.id[node.node]])));
    if (moved > limit + 0.5 * (level.radius - levels[1].radius) / kInflate) return false;
  }
  return true;
}

void Hierarchy::Impl::repair_if_pending() {
  if (!pending) return;
  change_or_empty([&] {
    set_wrap_slack();
    with_metric(box, [&](const auto& metric) {
      refresh_centers(metric);
      repair(metric, 0);
    });
  });
}

// Both sides are this structure's own wall-clock times: of its last build, and of the sweep and the orphans
// of its repairs so far. Until both have been seen once, repair, which is what measures them. Each orphan
// brings the next reordering nearer and pays its share of that.
bool Hierarchy::Impl::repair_pays(std::int64_t orphans) const {
  if (!build_per_point.known() || !sweep_per_point.known() || !per_orphan.known()) return true;
  const auto n = static_cast<double>(raw.size());
  const double orphan_seconds = per_orphan.seconds() + reorder_per_point.seconds() / kStrayed;
  return sweep_per_point.seconds() * n + orphan_seconds * static_cast<double>(orphans) <
         build_per_point.seconds() * n;
}

#define DCH_INSTANTIATE(Metric)                          \
  template void Hierarchy::Impl::measure(const Metric&); \
  template void Hierarchy::Impl::refresh_centers(const Metric&);
DCH_INSTANTIATE(detail::OpenMetric)
DCH_INSTANTIATE(detail::OrthorhombicMetric)
DCH_INSTANTIATE(detail::LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch
