// SPDX-License-Identifier: MIT
//
// What concerns the structure as a whole: lengths of levels, adding and dropping levels, giving all up.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

#include <dch/base/error.hpp>
#include <dch/base/index_count.hpp>

#include "base/describe.hpp"
#include "geometry/position_check.hpp"
#include "hierarchy/build/base_radius.hpp"
#include "hierarchy/hierarchy_impl.hpp"

namespace dch {

using detail::describe;
using detail::kNone;

/// Leaves are looked at in every image near enough, whose number grows with their extent in periods. One
/// that is chosen by the points is at most a few times the list radius, which a box bounds by its height.
void Hierarchy::Impl::check_base_radius(const Box& b) const {
  constexpr double kMaxPeriods = 16;
  const double limit = kMaxPeriods * b.min_height();
  if (params.base_radius <= limit || b.max_distance() <= limit) return;
  throw InvalidParameter("hierarchy parameter base_radius is " + describe(params.base_radius) +
                         ", more than " + describe(kMaxPeriods) + " times the smallest height of the box, " +
                         describe(b.min_height()) + "; leave it 0 for a choice by the points");
}

double Hierarchy::Impl::radius_of_level(int i) const { return std::ldexp(base_radius, i); }

double Hierarchy::Impl::threshold_of_level(int i) const {
  if (i == 0) return params.radius;
  if (params.edge_rule == detail::EdgeRule::thesis) return 2 * params.c * radius_of_level(i) + wrap_slack;
  const double slack = params.policy == MaintenancePolicy::automatic ? 2 * kMotionSlack * base_radius : 0;
  return params.radius + 2 * (radius_of_level(i) - radius_of_level(0)) + slack + wrap_slack;
}

void Hierarchy::Impl::set_base_radius(Span<const Vec3> positions) {
  if (params.base_radius > 0) {
    base_radius = params.base_radius;
  } else if (!finds_base_radius()) {
    base_radius = params.radius / (2 * params.c);
  } else {
    const double r0 = params.radius / (2 * params.c);
    const double wanted = detail::base_radius_for(positions, box, params.radius);
    base_radius = std::ldexp(r0, static_cast<int>(std::lround(std::log2(wanted / r0))));
  }
  for (int i = 0; i <= top(); ++i) set_lengths(i);
}

void Hierarchy::Impl::set_lengths(int i) {
  Level& level = levels[i];
  level.radius = radius_of_level(i);
  level.radius2 = level.radius * level.radius;
  level.threshold = threshold_of_level(i);
  level.threshold2 = level.threshold * level.threshold;
  level.reach = level.threshold + (i > 1 ? kEdgeSlack * level.radius : 0);
}

void Hierarchy::Impl::set_wrap_slack() {
  wrap_slack = 2 * detail::WrapError(box).bound(largest_reach);  // twice, so that insertions seldom exceed it
  for (int i = 0; i <= top(); ++i) set_lengths(i);
}

void Hierarchy::Impl::push_level() {
  levels.emplace_back();
  set_lengths(top());
  levels.back().complete = levels.back().reach;
}

void Hierarchy::Impl::pop_level() {
  levels.pop_back();
  Level& roots = levels.back();
  for (auto* links : {&roots.parent, &roots.up, &roots.next_sibling, &roots.prev_sibling})
    std::fill(links->begin(), links->end(), kNone);
}

/// The smallest id that no point has.
std::int32_t Hierarchy::Impl::take_free_id() {
  std::int32_t id;
  if (free_ids.empty()) {
    id = static_cast<std::int32_t>(slot_of_id.size());
    slot_of_id.push_back(kNone);
    raw.emplace_back();
  } else {
    std::pop_heap(free_ids.begin(), free_ids.end(), std::greater<>());
    id = free_ids.back();
    free_ids.pop_back();
  }
  return id;
}

std::size_t Hierarchy::Impl::memory_bytes() const {
  std::size_t bytes = (raw.capacity() + anchors.capacity()) * sizeof(Vec3) +
                      (slot_of_id.capacity() + free_ids.capacity()) * sizeof(std::int32_t);
  bytes += singletons.capacity() * sizeof(Singleton);
  for (const Level& level : levels) bytes += level.memory_bytes();
  return bytes + points.memory_bytes() + leaves.memory_bytes() + (balls ? balls->memory_bytes() : 0);
}

void Hierarchy::Impl::reset(const Box& b) {
  box = b;
  base_radius = params.base_radius > 0 ? params.base_radius : params.radius / (2 * params.c);
  wrap_slack = 0;
  largest_reach = 0;
  misplaced = 0;
  pending = false;
  note_new_places();
  balls.reset();
  levels.clear();
  points.clear();
  singletons.clear();
  placing_later = false;
  batch_hint = {};
  raw.clear();
  slot_of_id.clear();
  free_ids.clear();
  push_level();
  push_level();
}

}  // namespace dch
