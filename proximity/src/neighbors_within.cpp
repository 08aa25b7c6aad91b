// SPDX-License-Identifier: MIT
#include <optional>
#include <string>
#include <type_traits>

#include <dch/base/error.hpp>
#include <dch/proximity/neighbors_within.hpp>

#include "base/describe.hpp"
#include "geometry/metric.hpp"
#include "geometry/position_check.hpp"
#include "hierarchy/subtree_balls.hpp"
#include "nearest_descent.hpp"
#include "within_candidates.hpp"

namespace dch {

struct NeighborsWithin::Impl {
  explicit Impl(const detail::Structure& s) : structure(s) {
    if (!s.balls) measured.emplace(s);
  }

  /// Rows for queries at position_of(k), which leave the point self_of(k) out.
  template <class Position, class Self>
  NeighborsWithinRows search(std::size_t queries, double radius, const Position& position_of,
                             const Self& self_of) const {
    NeighborsWithinRows rows;
    detail::WithinCandidates near(radius);
    detail::with_metric(structure.box, [&](const auto& metric) {
      detail::NearestDescent<std::decay_t<decltype(metric)>, detail::WithinCandidates> descent(
          metric, structure, measured ? *measured : *structure.balls);
      for (std::size_t k = 0; k < queries; ++k) {
        near.clear();
        descent.search(position_of(k), self_of(k), 0, near);
        near.append_to(rows.id, rows.distance2);
        rows.first.push_back(static_cast<std::int64_t>(rows.id.size()));
      }
      rows.work = descent.work;
    });
    return rows;
  }
  void check_radius(double radius) const {
    if (!(radius >= 0))
      throw InvalidParameter("the radius of a neighbor query is " + detail::describe(radius) +
                             "; it must be 0 or more");
    if (radius > structure.box.max_cutoff())
      throw CutoffTooLarge("the radius of a neighbor query is " + detail::describe(radius) + ", above " +
                           detail::describe(structure.box.max_cutoff()) +
                           ", half the smallest height of the periodic box: a point may have several images "
                           "so near; lower the radius, or replicate the system");
  }

  const detail::Structure& structure;
  std::optional<detail::SubtreeBalls> measured;  ///< where the hierarchy keeps none up
};

NeighborsWithin::NeighborsWithin(const HierarchyView& view)
    : impl_(std::make_unique<Impl>(view.structure())) {}
NeighborsWithin::~NeighborsWithin() = default;
NeighborsWithin::NeighborsWithin(NeighborsWithin&&) noexcept = default;
NeighborsWithin& NeighborsWithin::operator=(NeighborsWithin&&) noexcept = default;

NeighborsWithinRows NeighborsWithin::of_points(Span<const std::int32_t> ids, double radius) const {
  impl_->check_radius(radius);
  for (const std::int32_t id : ids)
    if (!impl_->structure.contains(id))
      throw InvalidParameter("neighbors of point " + std::to_string(id) +
                             " were asked for, and there is no point with that id; ask about points that "
                             "the hierarchy contains");
  return impl_->search(
      ids.size(), radius,
      [&](std::size_t k) { return impl_->structure.raw[static_cast<std::size_t>(ids[k])]; },
      [&](std::size_t k) { return ids[k]; });
}

NeighborsWithinRows NeighborsWithin::of_positions(Span<const Vec3> positions, double radius) const {
  impl_->check_radius(radius);
  detail::check_positions(positions, impl_->structure.box);
  return impl_->search(
      positions.size(), radius, [&](std::size_t k) { return positions[k]; },
      [](std::size_t) { return detail::kNone; });
}

}  // namespace dch
