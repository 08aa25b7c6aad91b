// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/proximity/kept_nearest.hpp>

#include "changed_ids.hpp"
#include "geometry/metric.hpp"
#include "geometry/position_check.hpp"
#include "hierarchy/structure.hpp"
#include "hierarchy/subtree_balls.hpp"
#include "point_cell_search.hpp"
#include "point_cells.hpp"
#include "position_nearest.hpp"

namespace dch {
namespace {

using detail::Structure;

/// Positions after which it is counted anew whether the grid pays.
constexpr std::size_t kTurn = 1024;
/// Work that a descent has, in lines and points, at the least, and more for each neighbor.
constexpr std::int64_t kDescent = 64, kDescentOfANeighbor = 8;
/// To change a cell.
constexpr std::int64_t kChange = 4;
/// Work that a grid may lose before it is given up.
constexpr std::int64_t kMostCredit = 1 << 13;
/// A grid is made when as many positions as this share of all points have been asked for.
constexpr std::int64_t kShareOfPoints = 4;
/// So many times as many after one that was given up.
constexpr std::int64_t kPatience = 4, kMostPatience = 256;

/// One position after the other, by a grid.
class GridNearest {
 public:
  /// @return whether there is an answer
  bool search(const detail::PointCells& grid, const Structure& structure, const NearestParams& params,
              Vec3 position, std::size_t row, NearestRows& rows) {
    if (!search_.nearest(grid, position, params.k, params.epsilon)) return false;
    if (params.k > 1)
      for (const auto& found : search_.found())
        __builtin_prefetch(&structure.raw[static_cast<std::size_t>(found.id)]);
    best_.clear(params.k);
    for (const auto& found : search_.found())
      best_.add(structure.box.distance2(position, structure.raw[static_cast<std::size_t>(found.id)]),
                found.id);
    if (!best_.is_full() || std::sqrt(best_.limit2()) > search_.bound()) return false;
    detail::write_row(best_, row, rows);
    return true;
  }
  NearestWork take_work() { return std::exchange(search_.work, {}); }

 private:
  detail::PointCellSearch search_;
  detail::NearestCandidates best_;
};

/// Calls do_part(part, begin, end) for shares of a count, on the threads of an executor if there is one.
template <class DoPart>
void share(Executor* executor, std::int32_t count, const DoPart& do_part) {
  const int parts = executor ? executor->threads() : 1;
  if (parts == 1 || count == 1) return do_part(0, 0, count);
  executor->run(parts, [&](int part) {
    do_part(part, share_begin(count, part, parts), share_begin(count, part + 1, parts));
  });
}

}  // namespace

struct KeptNearest::Impl {
  // Upkeep
  void take(const Structure& next);
  void change(const Structure& now, std::int32_t id);
  bool must_take_all(const Structure& next) const {
    return !is_whole || &next != structure || next.box != box || next.slot_of_id.size() < ids;
  }
  void prefetch(const Structure& now, Span<const std::int32_t> changed) const;
  void make_grid_if_it_pays();
  void settle_credit(std::int64_t earned);

  // Questions: of positions[order[k]], first <= k < first + count
  struct Questions {
    Span<const Vec3> positions;
    Span<const std::int32_t> order;
    const NearestParams& params;
    NearestRows& rows;
  };
  void answer(const Questions& questions);
  void ask_grid(const Questions& questions);
  void descend(const Questions& questions);
  const detail::SubtreeBalls& balls();

  KeptNearestWork work;
  bool is_whole = false;
  const Structure* structure = nullptr;
  Box box;
  std::size_t ids = 0;
  std::optional<detail::SubtreeBalls> measured;
  detail::PointCells grid;  ///< or empty
  std::int64_t asked = 0;   ///< positions, since a grid was made
  std::int64_t patience = 1;
  std::int64_t credit = 0;
  std::vector<GridNearest> tools;  ///< of threads
  std::vector<char> is_answered;
  std::vector<std::int32_t> left;  ///< that the grid did not answer
};

void KeptNearest::Impl::take(const Structure& next) {
  grid.clear();
  structure = &next;
  box = next.box;
  ids = next.slot_of_id.size();
  make_grid_if_it_pays();
}

void KeptNearest::Impl::make_grid_if_it_pays() {
  const auto points = static_cast<std::int64_t>(structure->count());
  if (points == 0 || (work.grids > 0 && asked * kShareOfPoints < patience * points)) return;
  asked = 0;
  credit = kMostCredit;
  ++work.grids;
  grid.make(*structure);
}

void KeptNearest::Impl::settle_credit(std::int64_t earned) {
  credit = std::min(credit + earned, kMostCredit);
  if (credit >= 0) return;
  grid.clear();
  patience = std::min(kPatience * patience, kMostPatience);
}

void KeptNearest::Impl::change(const Structure& now, std::int32_t id) {
  if (grid.empty()) return;
  grid.remove(id);
  if (now.contains(id)) grid.insert(id, now.raw[static_cast<std::size_t>(id)]);
}

void KeptNearest::Impl::prefetch(const Structure& now, Span<const std::int32_t> changed) const {
  if (grid.empty()) return;
  for (const std::int32_t id : changed) grid.prefetch(id, now.raw[static_cast<std::size_t>(id)]);
}

const detail::SubtreeBalls& KeptNearest::Impl::balls() {
  if (structure->balls) return *structure->balls;
  if (!measured) measured.emplace(*structure);
  return *measured;
}

void KeptNearest::Impl::answer(const Questions& questions) {
  asked += static_cast<std::int64_t>(questions.order.size());
  if (grid.empty()) make_grid_if_it_pays();
  if (grid.empty()) return descend(questions);
  ask_grid(questions);
  if (!left.empty()) descend({questions.positions, left, questions.params, questions.rows});
}

void KeptNearest::Impl::ask_grid(const Questions& questions) {
  const std::size_t count = questions.order.size();
  is_answered.assign(count, 0);
  tools.resize(
      static_cast<std::size_t>(questions.params.executor ? questions.params.executor->threads() : 1));
  share(questions.params.executor, static_cast<std::int32_t>(count),
        [&](int part, std::int32_t begin, std::int32_t end) {
          for (std::int32_t q = begin; q < end; ++q) {
            const auto k = static_cast<std::size_t>(q);
            const auto row = static_cast<std::size_t>(questions.order[k]);
            const Vec3 position = questions.positions[row];
            const bool is_found = tools[static_cast<std::size_t>(part)].search(
                grid, *structure, questions.params, position, row, questions.rows);
            is_answered[k] = is_found ? 1 : 0;
          }
        });
  left.clear();
  for (std::size_t k = 0; k < count; ++k)
    if (!is_answered[k]) left.push_back(questions.order[k]);
  NearestWork spent;
  for (GridNearest& tool : tools) detail::add(tool.take_work(), spent);
  detail::add(spent, questions.rows.work);
  const auto answered = static_cast<std::int64_t>(count - left.size());
  work.by_grid += answered;
  settle_credit(answered * (kDescent + kDescentOfANeighbor * questions.params.k) - spent.blocks -
                spent.points);
}

void KeptNearest::Impl::descend(const Questions& questions) {
  work.descents += static_cast<std::int64_t>(questions.order.size());
  const detail::SubtreeBalls& known = balls();
  std::vector<NearestWork> spent(
      static_cast<std::size_t>(questions.params.executor ? questions.params.executor->threads() : 1));
  detail::with_metric(structure->box, [&](const auto& metric) {
    share(questions.params.executor, static_cast<std::int32_t>(questions.order.size()),
          [&](int part, std::int32_t begin, std::int32_t end) {
            detail::PositionNearest<std::decay_t<decltype(metric)>> tool(metric, *structure, known,
                                                                         questions.params);
            for (std::int32_t q = begin; q < end; ++q) {
              const auto row = static_cast<std::size_t>(questions.order[static_cast<std::size_t>(q)]);
              tool.search(questions.positions[row], row, questions.rows);
            }
            spent[static_cast<std::size_t>(part)] = tool.work();
          });
  });
  for (const NearestWork& of_part : spent) detail::add(of_part, questions.rows.work);
}

KeptNearest::KeptNearest() : impl_(std::make_unique<Impl>()) {}
KeptNearest::~KeptNearest() = default;
KeptNearest::KeptNearest(KeptNearest&&) noexcept = default;
KeptNearest& KeptNearest::operator=(KeptNearest&&) noexcept = default;

void KeptNearest::update(const HierarchyView& view) {
  Impl& kept = *impl_;
  kept.is_whole = false;
  kept.measured.reset();
  kept.take(view.structure());
  kept.is_whole = true;
}

void KeptNearest::update(const HierarchyView& view, Span<const std::int32_t> changed) {
  Impl& kept = *impl_;
  detail::check_changed(changed, view);
  if (kept.must_take_all(view.structure())) return update(view);
  kept.is_whole = false;
  kept.measured.reset();
  const std::size_t before = std::exchange(kept.ids, view.capacity());
  if (!kept.grid.empty()) kept.grid.grow(kept.ids);
  kept.prefetch(view.structure(), changed);
  for (const std::int32_t id : changed) kept.change(view.structure(), id);
  for (std::size_t id = before; id < kept.ids; ++id)
    kept.change(view.structure(), static_cast<std::int32_t>(id));
  if (!kept.grid.empty()) kept.settle_credit(-kChange * static_cast<std::int64_t>(changed.size()));
  kept.is_whole = true;
}

void KeptNearest::of_positions(Span<const Vec3> positions, const NearestParams& params, NearestRows& rows) {
  Impl& kept = *impl_;
  detail::check(params);
  if (kept.structure == nullptr)
    throw InvalidParameter("nearest points were asked for before there were any; call update() first");
  detail::check_positions(positions, kept.structure->box);
  detail::make_rows(positions.size(), params.k, rows);
  rows.work = {};
  if (!kept.is_whole) kept.grid.clear();
  const std::vector<std::int32_t> order = detail::order_of_queries(positions, *kept.structure);
  for (std::size_t first = 0; first < order.size(); first += kTurn)
    kept.answer({positions, {order.data() + first, std::min(kTurn, order.size() - first)}, params, rows});
}

const KeptNearestWork& KeptNearest::work() const { return impl_->work; }

}  // namespace dch
