// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <dch/base/error.hpp>
#include <dch/base/index_count.hpp>

#include "base/describe.hpp"
#include "geometry/position_check.hpp"
#include "hierarchy/hierarchy_impl.hpp"

namespace dch {

using detail::describe;
using detail::kNone;
using detail::with_metric;

namespace {

detail::StructureParams checked(const detail::StructureParams& p) {
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
  if (p.base_radius != 0 && p.edge_rule == detail::EdgeRule::thesis)
    throw InvalidParameter("hierarchy parameter base_radius is " + describe(p.base_radius) +
                           "; the thesis's edge rule ties it to radius / (2 c): leave it 0");
  if (p.max_roots < 1)
    throw InvalidParameter("max_roots is " + std::to_string(p.max_roots) + "; it must be at least 1");
  return p;
}

/// Moves the value of each old id to its new one, and drops those of ids that have none.
/// @param new_of_old kNone for the latter
template <class Value>
void gather_in_place(Span<const std::int32_t> old_of_new, const std::vector<std::int32_t>& new_of_old,
                     std::vector<Value>& values) {
  const auto n = static_cast<std::int32_t>(old_of_new.size());
  std::vector<char> is_done(old_of_new.size(), 0);
  // A chain of places, each of which takes what the next one holds, ends where that is beyond them, or is
  // where the chain began.
  const auto follow = [&](std::int32_t first) {
    const Value held = values[first];
    std::int32_t to = first;
    while (to < n && !is_done[to]) {
      const std::int32_t from = old_of_new[to];
      is_done[to] = 1;
      values[to] = from == first ? held : values[from];
      to = from;
    }
  };
  for (std::int32_t k = 0; k < n; ++k)
    if (new_of_old[k] == kNone) follow(k);
  for (std::int32_t k = 0; k < n; ++k)
    if (!is_done[k]) follow(k);
  values.resize(old_of_new.size());
}

}  // namespace

Hierarchy::Hierarchy(const HierarchyParams& params) : Hierarchy(detail::StructureParams(params)) {}
Hierarchy::Hierarchy(const detail::StructureParams& params)
    : impl_(std::make_unique<Impl>(checked(params))) {}
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
  // Asked before anything changes: the point may take an id and a block, and so may each singleton that it
  // expands.
  if (h.free_ids.empty())
    index_count(static_cast<std::int64_t>(h.slot_of_id.size()) + 1, "points", "take fewer");
  detail::block_count(static_cast<std::int64_t>(h.points.leaf.size() + h.singletons.size()) + 1,
                      h.points.most);
  h.repair_if_pending();
  std::int32_t id = kNone;
  h.change_or_empty([&] {
    h.largest_reach = std::max(h.largest_reach, reach);
    h.note_new_places();
    id = h.take_free_id();
    with_metric(h.box, [&](const auto& metric) {
      h.insert(metric, id, position, near == kNone ? Impl::Hint{} : h.lowest_node(near));
    });
    h.allow_for_far_points();
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
  gather_in_place(old_of_new, new_of_old, h.raw);
  gather_in_place(old_of_new, new_of_old, h.slot_of_id);
  h.free_ids.clear();
  const auto rename = [&](std::vector<std::int32_t>& ids) {
    for (std::int32_t& id : ids)
      if (id != kNone) id = new_of_old[id];
  };
  rename(h.points.id);
  for (auto& level : h.levels) rename(level.id);
}

std::size_t Hierarchy::size() const { return impl_->count(); }
std::size_t Hierarchy::capacity() const { return impl_->slot_of_id.size(); }
bool Hierarchy::contains(std::int32_t id) const { return impl_->contains(id); }
const Box& Hierarchy::box() const { return impl_->box; }
const HierarchyParams& Hierarchy::params() const { return impl_->params; }
bool Hierarchy::repair_pending() const { return impl_->pending; }
void Hierarchy::repair() { impl_->repair_if_pending(); }
bool Hierarchy::exchange_pays(std::size_t points) const { return impl_->exchange_pays(points); }
void Hierarchy::clear() noexcept { impl_->reset(Box()); }

HierarchyView Hierarchy::view() {
  with_metric(impl_->box, [&](const auto& metric) { impl_->measure(metric); });
  return HierarchyView(*impl_);
}

HierarchyView Hierarchy::kept_view() {
  if (impl_->balls) return HierarchyView(*impl_);
  const HierarchyView measured = view();
  impl_->balls.emplace(*impl_);
  return measured;
}

const SearchStats& Hierarchy::stats() const {
  SearchStats& s = impl_->stats;
  s.levels = static_cast<int>(impl_->levels.size());
  s.memory_bytes = impl_->memory_bytes();
  return s;
}

}  // namespace dch
