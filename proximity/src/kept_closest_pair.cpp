// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <dch/proximity/kept_closest_pair.hpp>

#include "changed_ids.hpp"
#include "closest_bounds.hpp"
#include "closest_candidate.hpp"
#include "closest_cells.hpp"
#include "displacements.hpp"
#include "geometry/metric.hpp"
#include "geometry/position_check.hpp"
#include "geometry/tolerance.hpp"
#include "hierarchy/structure.hpp"
#include "hierarchy/subtree_balls.hpp"
#include "nearest_descent.hpp"

namespace dch {
namespace {

using detail::ClosestBounds;
using detail::Structure;

constexpr double kFar = ClosestBounds::kFar;

/// A point looks for others within this many times the smallest distance: farther, fewer questions later, but
/// more work for each.
constexpr double kReach = 4;
/// And for as many steps of motion, where all points move.
constexpr double kSteps = 16;
/// Of all points, the share of those that are asked when all at once take no longer.
constexpr std::size_t kShareOfAll = 8;

}  // namespace

struct KeptClosestPair::Impl {
  // What has changed
  void take_all(const Structure& structure);
  void compare_all(const Structure& structure);
  void look_at(const Structure& structure, std::int32_t id);
  void grow(const Structure& structure);
  bool must_take_all(const Structure& structure) const {
    return !is_whole || structure.box != box || structure.slot_of_id.size() < seen.size();
  }

  // Questions
  ClosestPoints answer(const HierarchyView& view, bool may_ask_all, Executor* executor);
  void ask_all(const HierarchyView& view, Executor* executor);
  template <class Ask>
  void settle(const Ask& ask);
  bool ask_cells(const Structure& structure, std::int32_t id, double reach,
                 detail::ClosestCandidate& nearest);
  double known_distance(const Structure& structure) const;

  void add_work(const NearestWork& more) {
    work.nearest.nodes += more.nodes;
    work.nearest.blocks += more.blocks;
    work.nearest.points += more.points;
  }
  bool is_there(std::int32_t id) const { return were_there[static_cast<std::size_t>(id)] != 0; }

  KeptClosestWork work;
  bool is_whole = false;
  std::int64_t now = 0;  ///< number of the call
  Box box;
  std::vector<Vec3> seen;             ///< by id
  std::vector<char> were_there;       ///< by id
  std::vector<std::int32_t> changed;  ///< in this call: they ask first
  ClosestBounds bounds;
  ClosestBounds::Pair last;
  detail::ClosestCells cells;  ///< of `seen`, or empty
  double rounding = 0;         ///< by which distances may have been off in the call before [length]
  double motion = 0;           ///< by how much distances may have shrunk since the call before [length]
};

void KeptClosestPair::Impl::take_all(const Structure& structure) {
  box = structure.box;
  seen = structure.raw;
  were_there.assign(seen.size(), 0);
  for (std::size_t k = 0; k < seen.size(); ++k)
    were_there[k] = structure.contains(static_cast<std::int32_t>(k)) ? 1 : 0;
  bounds.forget_all(were_there);
  changed.clear();
  cells.forget();
  last = {};
  motion = 0;
}

void KeptClosestPair::Impl::grow(const Structure& structure) {
  const std::size_t ids = structure.slot_of_id.size();
  seen.resize(ids);
  were_there.resize(ids, 0);
  bounds.grow(ids);
  cells.grow(ids);
}

/// A point that is where it was has nothing to ask.
void KeptClosestPair::Impl::look_at(const Structure& structure, std::int32_t id) {
  ++work.compared;
  const auto k = static_cast<std::size_t>(id);
  const bool is_there_now = structure.contains(id);
  if (is_there_now == is_there(id) && (!is_there_now || seen[k] == structure.raw[k])) return;
  if (is_there(id)) cells.remove(id);
  were_there[k] = is_there_now ? 1 : 0;
  seen[k] = structure.raw[k];
  if (is_there_now) cells.insert(id, seen[k]);
  if (is_there_now) {
    bounds.note_change(id, now);
    changed.push_back(id);
  } else {
    bounds.remove(id, now);
  }
}

/// Where many points move, most of them keep what they know, less what the motion takes away.
void KeptClosestPair::Impl::compare_all(const Structure& structure) {
  detail::Displacements displacements;
  std::vector<std::pair<std::int32_t, double>> moved;
  changed.clear();
  const auto points = static_cast<std::int32_t>(seen.size());
  for (std::int32_t id = 0; id < points; ++id) {
    const auto k = static_cast<std::size_t>(id);
    if (!is_there(id) || !structure.contains(id)) {
      look_at(structure, id);
    } else if (seen[k] == structure.raw[k]) {
      ++work.compared;
    } else {
      moved.emplace_back(id, box.distance2(seen[k], structure.raw[k]));
      displacements.add(moved.back().second);
    }
  }
  // Places of before may have been farther out.
  const double off = std::max(rounding, detail::WrapError(box).bound(structure.largest_reach));
  const double jump2 = displacements.jump2(seen.size(), off, last.distance2);
  motion = 0;
  if (jump2 > 0) {
    motion = (2 * std::sqrt(jump2) + 4 * off) * detail::kInflate;
    bounds.shrink_all(motion);
    cells.clear();
  }
  for (const auto& [id, square] : moved) {
    if (square >= jump2) {
      look_at(structure, id);
    } else {
      ++work.compared;
      seen[static_cast<std::size_t>(id)] = structure.raw[static_cast<std::size_t>(id)];
    }
  }
}

/// An upper bound, if there is one without a search.
double KeptClosestPair::Impl::known_distance(const Structure& structure) const {
  if (last.a < 0 || !is_there(last.a) || !is_there(last.b)) return kFar;
  return std::sqrt(structure.box.distance2(seen[static_cast<std::size_t>(last.a)],
                                           seen[static_cast<std::size_t>(last.b)]));
}

void KeptClosestPair::Impl::ask_all(const HierarchyView& view, Executor* executor) {
  ++work.searches;
  NearestParams params;
  params.executor = executor;
  const NearestRows rows = Nearest(view).of_points(params);
  std::vector<ClosestBounds::Pair> pairs(rows.id.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto id = static_cast<std::int32_t>(k);
    if (rows.id[k] >= 0) pairs[k] = {rows.distance2[k], std::min(id, rows.id[k]), std::max(id, rows.id[k])};
  }
  bounds.set_all(std::move(pairs), now);
  changed.clear();
  add_work(rows.work);
}

/// Has points ask until none may have a pair that comes before the closest one known. Where points coincide,
/// no pair comes before it but one of a smaller id, so these are asked instead if they are fewer.
template <class Ask>
void KeptClosestPair::Impl::settle(const Ask& ask) {
  for (const std::int32_t id : changed) ask(id, bounds.closest().distance2);
  for (std::int32_t asked = 0;;) {
    const ClosestBounds::Pair closest = bounds.closest();
    const std::int32_t next = bounds.next_below(std::sqrt(closest.distance2));
    if (next < 0) return;
    if (closest.distance2 == 0 && asked++ > closest.a) break;
    ask(next, closest.distance2);
  }
  for (std::int32_t id = 0; id <= bounds.closest().a; ++id)
    if (is_there(id)) ask(id, 0.0);
}

/// Returns false if cells have no answer.
bool KeptClosestPair::Impl::ask_cells(const Structure& structure, std::int32_t id, double reach,
                                      detail::ClosestCandidate& nearest) {
  const Vec3 at = seen[static_cast<std::size_t>(id)];
  return cells.for_each_within(structure, at, reach, [&](std::int32_t other) {
    if (other != id) nearest.add(box.distance2(at, seen[static_cast<std::size_t>(other)]), other);
  });
}

ClosestPoints KeptClosestPair::Impl::answer(const HierarchyView& view, bool may_ask_all, Executor* executor) {
  const Structure& structure = view.structure();
  const NearestWork before = work.nearest;
  const double known = known_distance(structure);
  rounding = detail::WrapError(box).bound(structure.largest_reach);
  if (may_ask_all && !structure.balls && bounds.count_below(known) > structure.count() / kShareOfAll)
    ask_all(view, executor);  // those that changed too
  std::optional<detail::SubtreeBalls> measured;
  detail::with_metric(structure.box, [&](const auto& metric) {
    std::optional<detail::NearestDescent<std::decay_t<decltype(metric)>, detail::ClosestCandidate>> descent;
    const auto descend = [&](std::int32_t id, detail::ClosestCandidate& best) {
      if (!descent) {
        if (!structure.balls) measured.emplace(structure);
        descent.emplace(metric, structure, measured ? *measured : *structure.balls);
      }
      cells.note_descent();
      descent->search(seen[static_cast<std::size_t>(id)], id, 0, best);
    };
    detail::ClosestCandidate nearest;
    settle([&](std::int32_t id, double closest2) {
      ++work.asked;
      const double distance = std::min(known, std::sqrt(closest2));
      const double least = std::max(kReach * distance, bounds.least_distance());
      const double reach = distance > 0 ? least + kSteps * motion : kFar;
      nearest.clear(reach * reach);
      if (!ask_cells(structure, id, reach, nearest)) descend(id, nearest);
      if (nearest.id() < 0) return bounds.set_none_within(id, reach);
      const auto [a, b] = std::minmax({id, nearest.id()});
      bounds.set_nearest(id, {nearest.limit2(), a, b}, now);
    });
    if (descent) add_work(descent->work);
  });
  add_work(cells.take_work());
  last = bounds.closest();
  is_whole = true;
  const NearestWork& after = work.nearest;
  return {last.a, last.b, last.distance2,
          after.nodes - before.nodes + after.blocks - before.blocks + after.points - before.points};
}

KeptClosestPair::KeptClosestPair() : impl_(std::make_unique<Impl>()) {}
KeptClosestPair::~KeptClosestPair() = default;
KeptClosestPair::KeptClosestPair(KeptClosestPair&&) noexcept = default;
KeptClosestPair& KeptClosestPair::operator=(KeptClosestPair&&) noexcept = default;

ClosestPoints KeptClosestPair::find(const HierarchyView& view, Executor* executor) {
  Impl& kept = *impl_;
  const bool takes_all = kept.must_take_all(view.structure());
  kept.is_whole = false;
  ++kept.now;
  if (takes_all) {
    kept.take_all(view.structure());
  } else {
    kept.grow(view.structure());
    kept.compare_all(view.structure());
  }
  return kept.answer(view, takes_all || kept.motion > 0, executor);
}

ClosestPoints KeptClosestPair::find(const HierarchyView& view, Span<const std::int32_t> changed) {
  Impl& kept = *impl_;
  detail::check_changed(changed, view);
  if (kept.must_take_all(view.structure())) return find(view);
  kept.is_whole = false;
  ++kept.now;
  kept.motion = 0;
  const auto before = static_cast<std::int32_t>(kept.seen.size());
  kept.grow(view.structure());
  kept.changed.clear();
  for (const std::int32_t id : changed) kept.look_at(view.structure(), id);
  for (std::int32_t id = before; id < static_cast<std::int32_t>(kept.seen.size()); ++id)
    kept.look_at(view.structure(), id);
  return kept.answer(view, false, nullptr);
}

const KeptClosestWork& KeptClosestPair::work() const { return impl_->work; }

}  // namespace dch
