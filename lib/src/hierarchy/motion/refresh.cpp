// SPDX-License-Identifier: MIT
//
// New positions: taken over and measured in one pass, and what is done then: nothing while the edges are
// certified to be enough for lists, else a repair or a new build, whichever is less work as counted.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>

#include "base/seconds_since.hpp"
#include "geometry/position_check.hpp"
#include "hierarchy/build/base_radius.hpp"
#include "hierarchy/hierarchy_impl.hpp"

namespace dch {

using detail::kNone;
using detail::kOrphansOfDemoted;
using detail::Level;
using detail::seconds_since;
using detail::with_metric;
using Clock = std::chrono::steady_clock;

namespace {
void add_orphans(double orphans, std::size_t neighbors_of_parent, detail::MaintenanceWork& work) {
  work.orphans += orphans;
  work.candidates += orphans * static_cast<double>(1 + neighbors_of_parent);
}
}  // namespace

void Hierarchy::Impl::update(Span<const Vec3> positions, const Box& b) {
  ++stats.updates;
  balls.reset();
  const auto start = Clock::now();
  try {
    largest_reach = take_positions(positions, b);
    detail::check_radius(params.radius, b);
    check_base_radius(b);
    // A build would bring removed points back.
    if (free_ids.empty() && (stats.builds == 0 || params.policy == MaintenancePolicy::always_rebuild)) {
      build(positions, b);
    } else {
      const bool same_box = box == b;
      box = b;
      for (Level& level : levels) level.complete = same_box ? level.complete : 0;
      if (!pending) anchors = levels[1].position;
      with_metric(box, [&](const auto& metric) {
        refresh_leaves(metric);
        if (params.policy == MaintenancePolicy::automatic && same_box && edges_are_certified(metric)) {
          pending = true;
          ++stats.refreshes;
          return;
        }
        set_wrap_slack();
        refresh_centers(metric);
        if (params.policy != MaintenancePolicy::always_repair && free_ids.empty() && !repair_pays(metric)) {
          build(positions, b);
        } else {
          repair(metric);
        }
      });
    }
  } catch (...) {
    reset(Box());
    throw;
  }
  stats.maintain_seconds += seconds_since(start);
}

/// Copies positions to `raw` and checks them, a cache of them at a time; those of free ids are not looked at.
/// Returns a bound on their WrapError::reach.
double Hierarchy::Impl::take_positions(Span<const Vec3> positions, const Box& b) {
  constexpr std::size_t kAtATime = 1024;
  std::mutex joining;
  double reach = 0;
  bool are_valid = true;
  for_ranges(params.executor, positions.size(), [&](std::size_t begin, std::size_t end) {
    double largest = 0;
    bool valid = true;
    for (std::size_t first = begin; first < end; first += kAtATime) {
      const std::size_t count = std::min(kAtATime, end - first);
      std::copy_n(positions.begin() + first, count, raw.begin() + static_cast<std::ptrdiff_t>(first));
      for (std::size_t id = first; id < first + count && !free_ids.empty(); ++id)
        if (slot_of_id[id] == kNone) raw[id] = b.origin();
      try {
        largest = std::max(largest, detail::check_positions({raw.data() + first, count}, b));
      } catch (const InvalidPosition&) {
        valid = false;
      }
    }
    const std::lock_guard lock(joining);
    reach = std::max(reach, largest);
    are_valid = are_valid && valid;
  });
  if (!are_valid) detail::check_positions({raw.data(), positions.size()}, b);  // which names the index
  return reach;
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
void Hierarchy::Impl::refresh_leaves(const Metric& metric) {
  refresh_level(metric, 1);
  order_blocks();
  leaves.refresh(metric, levels[1], raw, points, levels[0].radius2, params.executor);
  stats.distances += points.alive;
  measured = true;
}

template <class Metric>
void Hierarchy::Impl::refresh_centers(const Metric& metric) {
  for (int i = 2; i <= top(); ++i) refresh_level(metric, i);
}

template <class Metric>
detail::MaintenanceWork Hierarchy::Impl::work_ahead(const Metric& metric) {
  detail::MaintenanceWork work = standing_work();
  for (int i = 1; i <= top(); ++i) {
    count_uncovered(metric, i, work);
    count_demoted(metric, i, work);
  }
  return work;
}

/// Children that their parents in level i cover no more.
template <class Metric>
void Hierarchy::Impl::count_uncovered(const Metric& metric, int i, detail::MaintenanceWork& work) {
  const Level& level = levels[i];
  const double limit2 = levels[i - 1].radius2;
  if (i > 1) stats.distances += levels[i - 1].alive();
  for (std::int32_t k = 0; k < level.size(); ++k) {  // a dead node has no children
    std::int64_t orphans = i == 1 ? leaves.leaves[k].uncovered : 0;
    if (i > 1)
      for_each_child(i, k, [&](std::int32_t child) {
        orphans += metric.distance2(position(i - 1, child), level.position[k]) > limit2;
      });
    add_orphans(static_cast<double>(orphans), level.edges.row(k).size(), work);
  }
}

/// Children of those nodes of level i that have come too close to another one, as separate_level() will find.
template <class Metric>
void Hierarchy::Impl::count_demoted(const Metric& metric, int i, detail::MaintenanceWork& work) {
  const Level& level = levels[i];
  find_too_close(metric, i);
  std::vector<char> is_demoted(static_cast<std::size_t>(level.size()), 0);
  for (const auto& [a, b] : too_close) {
    if (is_demoted[a] || is_demoted[b]) continue;
    const std::int32_t node = keeps_first(i, a, b) ? b : a;
    is_demoted[node] = 1;
    double children = 0;
    for_each_child(i, node, [&](std::int32_t) { ++children; });
    add_orphans(kOrphansOfDemoted * children, level.edges.row(node).size(), work);
  }
}

detail::MaintenanceWork Hierarchy::Impl::standing_work() const {
  detail::MaintenanceWork work;
  work.points = static_cast<double>(raw.size());
  if (finds_base_radius()) work.samples = static_cast<double>(detail::density_samples(raw.size()));
  for (int i = 1; i <= top(); ++i) work.edges += static_cast<double>(levels[i].edges.entries());
  return work;
}

template <class Metric>
void Hierarchy::Impl::measure(const Metric& metric) {
  if (measured) return;
  order_blocks();
  if (points.keeps_positions) {
    leaves.measure(metric, levels[1], points, levels[0].radius2, params.executor);
  } else {
    leaves.refresh(metric, levels[1], raw, points, levels[0].radius2, params.executor);
  }
  if (balls) balls.emplace(*this);  // as they are
  measured = true;
}

// Two leaves without an edge were more than rho_1 apart when the structure was in order, so now they are
// more than rho_1 minus both displacements apart, and their points more than that minus both extents: more
// than rho_0 if extent plus displacement is at most (rho_1 - rho_0) / 2 for every leaf. Singletons count
// as leaves; one of level i was more than rho_1 + R_i - R_1 away from the leaves of all others.
template <class Metric>
bool Hierarchy::Impl::edges_are_certified(const Metric& metric) {
  if (detail::WrapError(box).bound(largest_reach) > wrap_slack) return false;
  const double limit = 0.5 * (levels[1].threshold - wrap_slack - params.radius) / kInflate;
  motion = 0;
  for (std::int32_t k = 0; k < levels[1].size(); ++k) {  // dead ones have no extent and stay where they were
    const double moved = std::sqrt(metric.distance2(anchors[k], levels[1].position[k]));
    if (leaves.leaves[k].extent + moved > limit) return false;
    motion = std::max(motion, moved);
  }
  for (const Singleton& node : singletons) {
    const Level& level = levels[node.level];
    const double moved =
        std::sqrt(metric.distance2(level.position[node.node], metric.wrap(raw[level.id[node.node]])));
    if (moved > limit + 0.5 * (level.radius - levels[1].radius) / kInflate) return false;
  }
  return true;
}

/// Points that lie much farther out than all before would have lists rely on thresholds that do not allow for
/// it.
void Hierarchy::Impl::allow_for_far_points() {
  if (detail::WrapError(box).bound(largest_reach) <= wrap_slack) return;
  set_wrap_slack();
  with_metric(box, [&](const auto& metric) { repair(metric); });
}

void Hierarchy::Impl::repair_if_pending() {
  if (!pending) return;
  change_or_empty([&] {
    set_wrap_slack();
    with_metric(box, [&](const auto& metric) {
      refresh_centers(metric);
      repair(metric);
    });
  });
}

template <class Metric>
bool Hierarchy::Impl::repair_pays(const Metric& metric) {
  ahead = work_ahead(metric);
  const detail::MaintenanceWeights& weights = detail::weights_in(box);
  return repair_cost(ahead, weights) <= build_cost(ahead, weights);
}

// A particle that comes needs a parent, as do those with one that goes if it is a center; where, is not known
// yet.
bool Hierarchy::Impl::exchange_pays(std::size_t particles) const {
  double near_all = 0;  // of all points in leaves, what a search near them looks at
  for (std::int32_t k = 0; k < levels[1].size(); ++k) {  // a dead node has no children
    const auto near_one = static_cast<double>(1 + levels[1].edges.row(k).size());
    for (std::int32_t block = levels[1].first_child[k]; block != kNone; block = points.next[block])
      near_all += near_one * points.count[block];
  }
  const auto& [particle, candidate] = detail::weights_in(box).exchange;
  const double one = particle + candidate * near_all / std::max(1, points.alive);
  return one * static_cast<double>(particles) <= build_cost(standing_work(), detail::weights_in(box));
}

#define DCH_INSTANTIATE(Metric) template void Hierarchy::Impl::measure(const Metric&);
DCH_INSTANTIATE(detail::OpenMetric)
DCH_INSTANTIATE(detail::OrthorhombicMetric)
DCH_INSTANTIATE(detail::LatticeMetric)
#undef DCH_INSTANTIATE

}  // namespace dch
