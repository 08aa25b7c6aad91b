// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>
#include <dch/proximity/nearest.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Counts since an object was made, for tests and for comparisons on any machine.
struct KeptNearestWork {
  std::int64_t by_grid = 0;   ///< positions whose nearest points the grid found
  std::int64_t descents = 0;  ///< positions whose nearest points a descent of the hierarchy found
  std::int64_t grids = 0;     ///< grids that were made, or tried where none fits
};

/// The nearest points of positions that are asked for one by one, while points come and go.
///
///     dch::KeptNearest kept;
///     kept.update(hierarchy.kept_view());                       // makes a grid of all points
///     hierarchy.remove(id);
///     const std::int32_t came = hierarchy.insert(position);
///     kept.update(hierarchy.kept_view(), changed_ids);          // id and came
///     dch::NearestRows row = kept.of_positions({&query, 1}, {});
///
/// Answers are those of Nearest::of_positions(), ids of points equally near included; with an epsilon they
/// may be others that are within it. A grid has the points by cells that hold two to three where most are; a
/// point that comes or goes changes one cell, and a question looks at the eight nearest cells, and at those
/// that the k-th point may be in: O(k) where density varies little. Positions in voids or in overfull cells
/// are asked for by descent (Theorem 5.6.9), those of triclinic boxes and of periodic boxes less than eight
/// cells wide, sixteen where few cells have points, always. A grid that is not worth its upkeep, as counted,
/// is given up; the next one is made when a quarter as many positions as there are points have been asked for
/// since it was made, four times as many after each that is given up, up to 64 positions a point.
///
/// Takes any view; of one by view() the balls of subtrees are measured at the first descent after update().
/// Not thread-safe. An object that has thrown std::bad_alloc answers by descent until it makes another grid.
class KeptNearest {
 public:
  KeptNearest();
  ~KeptNearest();
  KeptNearest(KeptNearest&&) noexcept;
  KeptNearest& operator=(KeptNearest&&) noexcept;

  /// Any point may have come, gone or moved, and the box may have changed. The view is looked at until the
  /// next update(), and must be good as long. O(n).
  void update(const HierarchyView& view);

  /// The same, told which ids may have come, gone or moved since the call before; ids beyond those of then
  /// are looked at anyway. Answers are wrong if one is left out. O(1) each. All are looked at if the box or
  /// the hierarchy is another one, or if there are fewer ids.
  /// @throws InvalidParameter, changing nothing, for an id beyond those of the hierarchy.
  void update(const HierarchyView& view, Span<const std::int32_t> changed);

  /// The nearest points of each position, which need not be one of a point; see Nearest::of_positions().
  /// @throws InvalidParameter before the first update(); else as Nearest::of_positions().
  void of_positions(Span<const Vec3> positions, const NearestParams& params, NearestRows& rows);
  NearestRows of_positions(Span<const Vec3> positions, const NearestParams& params) {
    NearestRows rows;
    of_positions(positions, params, rows);
    return rows;
  }

  const KeptNearestWork& work() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch
#pragma GCC visibility pop
