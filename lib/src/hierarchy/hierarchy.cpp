// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

#include <dch/base/error.hpp>
#include <dch/base/index_count.hpp>

#include "hierarchy/build/base_radius.hpp"
#include "base/describe.hpp"
#include "hierarchy/structure.hpp"
#include "geometry/position_check.hpp"

namespace dch {

using detail::describe;
using detail::kNone;
using detail::with_metric;

// --- levels
// -----------------------------------------------------------------------------------------------------

/// Clusters are looked at in every image near enough, whose number grows with their extent in periods. One
/// that is chosen by the points is at most a few times the list radius, which a box bounds by its height.
void Hierarchy::Impl::check_base_radius(const Box& b) const {
  constexpr double kMostPeriods = 16;
  const double limit = kMostPeriods * b.min_height();
  if (params.base_radius <= limit || b.max_distance() <= limit) return;
  throw InvalidParameter("hierarchy parameter base_radius is " + describe(params.base_radius) +
                         ", more than " + describe(kMostPeriods) + " times the smallest height of the box, " +
                         describe(b.min_height()) + "; leave it 0 for a choice by the points");
}

double Hierarchy::Impl::radius_of_level(int i) const { return std::ldexp(base_radius, i); }

double Hierarchy::Impl::threshold_of_level(int i) const {
  if (i == 0) return params.radius;
  if (params.edge_rule == EdgeRule::thesis) return 2 * params.c * radius_of_level(i) + wrap_slack;
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

std::int32_t Hierarchy::Impl::node_of(std::int32_t id, int level) const {
  if (id < 0 || static_cast<std::size_t>(id) >= slot_of_id.size()) return kNone;
  std::int32_t node = slot_of_id[id];
  int i = 0;
  if (is_lone_point(id)) {
    i = lone[lone_at(node)].level;
    node = i <= level ? lone[lone_at(node)].node : kNone;
  }
  for (; i < level && node != kNone; ++i) node = up(i, node);
  return node;
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
  std::size_t bytes =
      raw.capacity() * sizeof(Vec3) + (slot_of_id.capacity() + free_ids.capacity()) * sizeof(std::int32_t);
  bytes += lone.capacity() * sizeof(LoneNode);
  for (const Level& level : levels) bytes += level.memory_bytes();
  return bytes + points.memory_bytes() + cluster_points.memory_bytes() + list_finder.memory_bytes() +
         pair_finder.memory_bytes();
}

// --- building
// ---------------------------------------------------------------------------------------------------

void Hierarchy::Impl::reset(const Box& b) {
  box = b;
  base_radius = params.base_radius > 0 ? params.base_radius : params.radius / (2 * params.c);
  wrap_slack = 0;
  largest_reach = 0;
  strayed = 0;
  pending = false;
  note_new_places();
  levels.clear();
  points.clear();
  lone.clear();
  placing_later = false;
  batch_hint = {};
  raw.clear();
  slot_of_id.clear();
  free_ids.clear();
  push_level();
  push_level();
}

// --- public interface
// -------------------------------------------------------------------------------------------

namespace {

HierarchyParams checked(const HierarchyParams& p) {
  if (!(std::isfinite(p.radius) && p.radius >= kMinListRadius && p.radius <= kMaxListRadius))
    throw InvalidParameter("hierarchy radius (cutoff + skin) is " + describe(p.radius) +
                           "; it must be a finite length in 1e-30..1e30, use another unit of length");
  if (!(p.c >= kMinC && p.c <= kMaxC))
    throw InvalidParameter("hierarchy parameter c is " + describe(p.c) +
                           "; it must be in 1.05..1000 (at c = 1 parent and child edges change together)");
  if (!(p.base_radius == 0 ||
        (std::isfinite(p.base_radius) && p.base_radius >= kMinListRadius && p.base_radius <= kMaxListRadius)))
    throw InvalidParameter("hierarchy parameter base_radius is " + describe(p.base_radius) +
                           "; it must be a length in 1e-30..1e30, or 0 for a choice by the points");
  if (p.base_radius != 0 && p.edge_rule == EdgeRule::thesis)
    throw InvalidParameter("hierarchy parameter base_radius is " + describe(p.base_radius) +
                           "; the thesis's edge rule ties it to radius / (2 c): leave it 0");
  if (p.max_roots < 1)
    throw InvalidParameter("max_roots is " + std::to_string(p.max_roots) + "; it must be at least 1");
  return p;
}

}  // namespace

Hierarchy::Hierarchy(const HierarchyParams& params) : impl_(std::make_unique<Impl>(checked(params))) {}
Hierarchy::~Hierarchy() = default;
Hierarchy::Hierarchy(Hierarchy&&) noexcept = default;
Hierarchy& Hierarchy::operator=(Hierarchy&&) noexcept = default;

void Hierarchy::build(Span<const Vec3> positions, const Box& box) {
  impl_->change_or_empty([&] { impl_->build(positions, box); });
}

void Hierarchy::update(Span<const Vec3> positions, const Box& box) {
  if (positions.size() != capacity())
    throw InvalidParameter("update() got " + std::to_string(positions.size()) +
                           " positions for a hierarchy with ids 0.." + std::to_string(capacity()) +
                           " (exclusive); give one for each, or build() anew");
  impl_->update(positions, box);
}

std::int32_t Hierarchy::insert(Vec3 position, std::int32_t near) {
  const double reach = detail::check_positions(Span<const Vec3>(&position, 1), box());
  if (near != kNone && !contains(near))
    throw InvalidParameter("insert(): there is no point with id " + std::to_string(near) +
                           " to look near of");
  Impl& h = *impl_;
  // Asked before anything changes: the point may take an id and a block, and so may each lone point that it
  // unfolds.
  if (h.free_ids.empty())
    index_count(static_cast<std::int64_t>(h.slot_of_id.size()) + 1, "points", "take fewer");
  detail::block_count(static_cast<std::int64_t>(h.points.cluster.size() + h.lone.size()) + 1, h.points.most);
  h.repair_if_pending();
  std::int32_t id = kNone;
  h.change_or_empty([&] {
    h.largest_reach = std::max(h.largest_reach, reach);
    h.note_new_places();
    id = h.take_free_id();
    with_metric(h.box, [&](const auto& metric) {
      h.insert(metric, id, position, near == kNone ? Impl::Hint{} : h.lowest_node(near));
    });
  });
  ++h.stats.inserted;
  return id;
}

void Hierarchy::remove(std::int32_t id) {
  if (!contains(id)) throw InvalidParameter("remove(): there is no point with id " + std::to_string(id));
  Impl& h = *impl_;
  h.repair_if_pending();
  h.change_or_empty([&] {
    h.note_new_places();
    with_metric(h.box, [&](const auto& metric) { h.remove(metric, id); });
    h.free_ids.push_back(id);
    std::push_heap(h.free_ids.begin(), h.free_ids.end(), std::greater<>());
  });
  ++h.stats.removed;
}

void Hierarchy::renumber(Span<const std::int32_t> old_of_new) {
  Impl& h = *impl_;
  h.note_new_places();
  if (old_of_new.size() != size())
    throw InvalidParameter("renumber() got " + std::to_string(old_of_new.size()) + " ids for " +
                           std::to_string(size()) + " points");
  std::vector<std::int32_t> new_of_old(capacity(), kNone);
  for (std::size_t k = 0; k < old_of_new.size(); ++k) {
    const std::int32_t old = old_of_new[k];
    if (!contains(old) || new_of_old[old] != kNone)
      throw InvalidParameter("renumber(): id " + std::to_string(old) +
                             (contains(old) ? " is listed twice" : " is not in the hierarchy"));
    new_of_old[old] = static_cast<std::int32_t>(k);
  }
  std::vector<Vec3> raw(old_of_new.size());
  std::vector<std::int32_t> slots(old_of_new.size());
  for (std::size_t k = 0; k < old_of_new.size(); ++k) {
    raw[k] = h.raw[old_of_new[k]];
    slots[k] = h.slot_of_id[old_of_new[k]];
  }
  h.raw = std::move(raw);
  h.slot_of_id = std::move(slots);
  h.free_ids.clear();
  const auto rename = [&](std::vector<std::int32_t>& ids) {
    for (std::int32_t& id : ids)
      if (id != kNone) id = new_of_old[id];
  };
  rename(h.points.id);
  for (auto& level : h.levels) rename(level.id);
}

std::size_t Hierarchy::size() const { return impl_->slot_of_id.size() - impl_->free_ids.size(); }
std::size_t Hierarchy::capacity() const { return impl_->slot_of_id.size(); }
bool Hierarchy::contains(std::int32_t id) const {
  return id >= 0 && static_cast<std::size_t>(id) < capacity() && impl_->slot_of_id[id] != kNone;
}
const Box& Hierarchy::box() const { return impl_->box; }
const HierarchyParams& Hierarchy::params() const { return impl_->params; }
int Hierarchy::levels() const { return static_cast<int>(impl_->levels.size()); }

Vec3 Hierarchy::position(std::int32_t id) const {
  if (!contains(id)) throw InvalidParameter("position(): there is no point with id " + std::to_string(id));
  return impl_->raw[id];
}

LevelInfo Hierarchy::level(int i) const {
  if (i < 0 || i >= levels())
    throw InvalidParameter("level " + std::to_string(i) + " of a hierarchy with levels 0.." +
                           std::to_string(levels() - 1));
  const auto& level = impl_->levels[i];
  LevelInfo info;
  info.covering_radius = level.radius;
  info.edge_threshold = level.threshold;
  info.nodes = impl_->alive(i) + impl_->lone_above(i);
  info.edges = i > 0 ? level.edges.entries() / 2 : -1;
  for (std::int32_t k = 0; k < level.size(); ++k)
    info.max_degree =
        std::max<std::int64_t>(info.max_degree, static_cast<std::int64_t>(level.edges.row(k).size()));
  return info;
}

int Hierarchy::top_level(std::int32_t id) const {
  if (!contains(id)) throw InvalidParameter("top_level(): there is no point with id " + std::to_string(id));
  int i = impl_->is_lone_point(id) ? impl_->lowest_node(id).level : 0;
  while (i < impl_->top() && impl_->node_of(id, i + 1) != kNone) ++i;
  return i;
}

namespace {
[[noreturn]] void throw_not_in_level(std::int32_t id, int i) {
  throw InvalidParameter("point " + std::to_string(id) + " does not stand in level " + std::to_string(i));
}
}  // namespace

std::int32_t Hierarchy::parent(std::int32_t id, int i) const {
  if (impl_->stands_alone(id, i)) return id;
  const std::int32_t node = i < 0 || i >= levels() ? kNone : impl_->node_of(id, i);
  if (node == kNone) throw_not_in_level(id, i);
  const std::int32_t above = impl_->parent(i, node);
  return above == kNone ? kNone : impl_->levels[i + 1].id[above];
}

std::vector<std::int32_t> Hierarchy::neighbors(std::int32_t id, int i) const {
  if (impl_->stands_alone(id, i)) return {};
  const std::int32_t node = i < 0 || i >= levels() ? kNone : impl_->node_of(id, i);
  if (node == kNone) throw_not_in_level(id, i);
  std::vector<std::int32_t> nodes;
  with_metric(impl_->box, [&](const auto& metric) { impl_->neighbors(metric, i, node, nodes); });
  std::vector<std::int32_t> ids(nodes.size());
  std::transform(nodes.begin(), nodes.end(), ids.begin(), [&](std::int32_t k) { return impl_->id(i, k); });
  std::sort(ids.begin(), ids.end());
  return ids;
}

void Hierarchy::list(const ListParams& params, NeighborList& out) { impl_->lists({&params, 1}, {&out}); }
void Hierarchy::lists(Span<const ListParams> requests, std::vector<NeighborList>& out) {
  out.resize(requests.size());
  std::vector<NeighborList*> each;
  each.reserve(out.size());
  for (NeighborList& list : out) each.push_back(&list);
  impl_->lists(requests, each);
}
bool Hierarchy::repair_pending() const { return impl_->pending; }
void Hierarchy::repair() { impl_->repair_if_pending(); }
std::string Hierarchy::validate() const { return impl_->validate(); }

const SearchStats& Hierarchy::stats() const {
  SearchStats& s = impl_->stats;
  s.levels = levels();
  s.memory_bytes = impl_->memory_bytes();
  return s;
}

}  // namespace dch
