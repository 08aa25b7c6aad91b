// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include <dch/proximity/nearest.hpp>

#include "geometry/metric.hpp"
#include "geometry/position_check.hpp"
#include "hierarchy/subtree_balls.hpp"
#include "leaf_nearest.hpp"
#include "position_nearest.hpp"

namespace dch {

struct Nearest::Impl {
  explicit Impl(const detail::Structure& s) : structure(s) {
    if (!s.balls) measured.emplace(s);
  }
  /// Those that the hierarchy keeps, if it does.
  const detail::SubtreeBalls& balls() const { return measured ? *measured : *structure.balls; }

  const detail::Structure& structure;
  std::optional<detail::SubtreeBalls> measured;
};

namespace {

/// Of ids that are not there.
void clear_rows_of_none(const detail::Structure& structure, NearestRows& rows) {
  const auto k = static_cast<std::ptrdiff_t>(rows.k);
  for (const std::int32_t id : structure.free_ids) {
    std::fill_n(rows.id.begin() + id * k, k, -1);
    std::fill_n(rows.distance2.begin() + id * k, k, std::numeric_limits<double>::infinity());
  }
}

/// Shares queries among the threads of an executor, each with tools of its own, and adds up the work.
template <class Tool, class Make, class Search>
NearestWork share_queries(Executor* executor, std::int32_t count, const Make& make, const Search& search) {
  const int parts = executor ? executor->threads() : 1;
  const auto do_part = [&](int part) {
    Tool tool = make();
    for (std::int32_t q = share_begin(count, part, parts); q < share_begin(count, part + 1, parts); ++q)
      search(tool, q);
    return tool.work();
  };
  if (parts == 1) return do_part(0);
  std::vector<NearestWork> work(static_cast<std::size_t>(parts));
  executor->run(parts, [&](int part) { work[static_cast<std::size_t>(part)] = do_part(part); });
  NearestWork sum;
  for (const NearestWork& of_part : work) detail::add(of_part, sum);
  return sum;
}

}  // namespace

Nearest::Nearest(const HierarchyView& view) : impl_(std::make_unique<Impl>(view.structure())) {}
Nearest::~Nearest() = default;
Nearest::Nearest(Nearest&&) noexcept = default;
Nearest& Nearest::operator=(Nearest&&) noexcept = default;

void Nearest::of_points(const NearestParams& params, NearestRows& rows) const {
  detail::check(params);
  const detail::Structure& structure = impl_->structure;
  detail::make_rows(structure.slot_of_id.size(), params.k, rows);
  clear_rows_of_none(structure, rows);
  const std::vector<std::int32_t> alone = structure.singleton_ids();
  const std::int32_t leaves = structure.levels[1].size();
  detail::with_metric(structure.box, [&](const auto& metric) {
    using Tool = detail::LeafNearest<std::decay_t<decltype(metric)>>;
    rows.work = share_queries<Tool>(
        params.executor, leaves + static_cast<std::int32_t>(alone.size()),
        [&] { return Tool(metric, structure, impl_->balls(), params.k); },
        [&](Tool& tool, std::int32_t q) {
          if (q >= leaves) return tool.search_point(alone[static_cast<std::size_t>(q - leaves)], rows);
          if (structure.levels[1].is_alive(q)) tool.search_leaf(q, rows);
        });
  });
}

void Nearest::of_positions(Span<const Vec3> positions, const NearestParams& params, NearestRows& rows) const {
  detail::check(params);
  const detail::Structure& structure = impl_->structure;
  detail::check_positions(positions, structure.box);
  detail::make_rows(positions.size(), params.k, rows);
  const std::vector<std::int32_t> order = detail::order_of_queries(positions, structure);
  detail::with_metric(structure.box, [&](const auto& metric) {
    using Tool = detail::PositionNearest<std::decay_t<decltype(metric)>>;
    rows.work = share_queries<Tool>(
        params.executor, static_cast<std::int32_t>(positions.size()),
        [&] { return Tool(metric, structure, impl_->balls(), params); },
        [&](Tool& tool, std::int32_t q) {
          const auto row = static_cast<std::size_t>(order[static_cast<std::size_t>(q)]);
          tool.search(positions[row], row, rows);
        });
  });
}

}  // namespace dch
