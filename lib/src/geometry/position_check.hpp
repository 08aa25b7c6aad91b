// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

namespace dch::detail {

/// How far the distance of two points by their wrapped images can be from the pair distance that ListParams
/// defines, which starts from the positions as given: shifts by many or by very skewed cell vectors round.
/// Zero for points in an open box, about 1e-14 of the box for points near it, and about 1e-16 of the
/// coordinate for points far outside and for boxes far from the origin.
class WrapError {
 public:
  explicit WrapError(const Box& box);
  /// Bound for pairs of points whose reach() is at most `reach` [length].
  double bound(double reach) const { return amplification_ * (reach + cell_size_) + coordinate_error_; }
  /// How far out a point lies along the axes that shifts change [length].
  double reach(Vec3 p) const;
  /// Largest reach() with which bound() stays within `error` [length].
  double reach_within(double error) const;
  /// No point of the box between two corners has a larger reach() [length].
  double reach_between(Vec3 low, Vec3 high) const;

 private:
  Vec3 origin_;
  std::array<bool, 3> shifted_{};  ///< coordinates that lattice shifts change
  double amplification_ = 0;
  double cell_size_ = 0;
  double coordinate_error_ =
      0;  ///< of two wrapped points, by the size of the coordinates in the box [length]
};

/// check_positions() of positions that are looked at piece by piece, so that they can be used while they are
/// in a cache. Safe to use on several threads.
class PositionCheck {
 public:
  explicit PositionCheck(const Box& box);

  const WrapError& error() const { return error_; }
  /// What check_positions() returns for some positions; nothing if the box around them does not tell that all
  /// are right.
  std::optional<double> reach_by_box(Span<const Vec3> positions) const;
  /// Looks at them one after the other, and throws as check_positions() does.
  double reach_of_each(Span<const Vec3> positions) const;

 private:
  WrapError error_;
  double tolerance_, farthest_;
};

/// @throws InvalidParameter for more particles than 32-bit indices can name.
/// @throws InvalidPosition naming index and value if a coordinate is not finite or beyond kMaxCoordinate, or
/// so far
///   outside a periodic box that rounding leaves its place in the box uncertain by half the box.
/// @return a bound on WrapError::reach of the positions: that of the box around them; 0 if there are none
///   [length].
double check_positions(Span<const Vec3> positions, const Box& box);

/// @throws CutoffTooLarge if the radius (cutoff + skin) exceeds box.max_cutoff().
void check_radius(double radius, const Box& box);

}  // namespace dch::detail
