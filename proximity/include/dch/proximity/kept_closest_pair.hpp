// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>
#include <dch/proximity/closest_pair.hpp>
#include <dch/proximity/nearest.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Work since an object was made, for tests and for comparisons on any machine.
struct KeptClosestWork {
  std::int64_t compared = 0;  ///< points whose places were compared with those seen before
  std::int64_t asked = 0;     ///< points whose nearest neighbors were looked for, one by one
  std::int64_t searches = 0;  ///< searches for those of all points at once
  NearestWork nearest;        ///< of both
};

/// The closest pair of points that move, come and go, found anew at a cost that grows with what has changed.
///
///     dch::KeptClosestPair kept;
///     kept.find(hierarchy.kept_view());                        // looks at all points
///     hierarchy.remove(id);
///     const std::int32_t moved = hierarchy.insert(position);
///     kept.find(hierarchy.kept_view(), changed_ids).distance2;  // asks for those that changed
///
/// For each point either its nearest one is known, or a distance within which there is none. Of two points
/// one has to know of the pair, so a point that changes asks, and no other. A distance that is known stays a
/// lower bound when others go away, and shrinks by twice the motion where all points move a little; only
/// points whose bounds are below the smallest distance are asked again. Answers are those of closest_pair(),
/// of several closest pairs the one with the smallest ids, whatever happened to the hierarchy between two
/// calls.
///
/// Cost: a descent for each changed point, O(lg alpha) (Theorem 5.6.9 with a radius of four times the
/// smallest distance), O(lg n) for its place in a tournament, and the descents of those whose bounds are used
/// up: none in the mean if closest pairs come and go at random, all of n if an adversary removes the closest
/// pair again and again from points that are all as close. Finding out what has changed takes O(n), one
/// comparison a point, unless the ids are given. Where one in 128 of all points has asked by descent, and not
/// all move, a grid of cells takes the place of descents, O(1) each, in boxes whose axes are at right angles.
/// A box that differs from the one before has all points asked.
///
/// Takes any view; one by kept_view() costs nothing to make, and with view() all points at once are asked for
/// at a fifth of the time that they take one by one. Not thread-safe. An object that has thrown, but for
/// arguments that do not fit, holds nothing, and the next find() looks at all points.
class KeptClosestPair {
 public:
  KeptClosestPair();
  ~KeptClosestPair();
  KeptClosestPair(KeptClosestPair&&) noexcept;
  KeptClosestPair& operator=(KeptClosestPair&&) noexcept;

  /// The closest pair now. Compares all points with those of the call before.
  /// @param executor threads for searches of all points at once; null for that of the caller. Results do not
  /// depend on
  ///   it.
  ClosestPoints find(const HierarchyView& view, Executor* executor = nullptr);

  /// The same, told which ids may have come, gone or moved since the call before; ids beyond those of then
  /// are looked at anyway. The answer is wrong if one is left out.
  /// @throws InvalidParameter, changing nothing, for an id beyond those of the hierarchy.
  ClosestPoints find(const HierarchyView& view, Span<const std::int32_t> changed);

  const KeptClosestWork& work() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch
#pragma GCC visibility pop
