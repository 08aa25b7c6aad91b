// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include <dch/geometry/box.hpp>

#include "simd/block_measure.hpp"

namespace dch::detail {

/// Distances between points that wrap(), which is Box::wrap, has put into the cell. All three are bitwise
/// symmetric in p and q, which the structural predicates rely on: a tie must come out the same from both
/// sides.
struct OpenMetric {
  explicit OpenMetric(const Box&) {}
  static Vec3 wrap(Vec3 p) { return p; }
  static BrickCell brick() { return {}; }
  static Vec3 displacement(Vec3 p, Vec3 q) { return q - p; }
  static double distance2(Vec3 p, Vec3 q) { return norm2(q - p); }
};

struct OrthorhombicMetric {
  explicit OrthorhombicMetric(const Box& b) : box(&b) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!b.periodic(axis)) continue;
      length[axis] = b.vector(axis)[axis];
      half[axis] = 0.5 * length[axis];
      low[axis] = b.origin()[axis];
      high[axis] = low[axis] + length[axis];
    }
  }
  /// Most points outside are in the next cell. Selects, not branches: their outcome is random.
  static double from_next_cell(double x, double low, double high, double length) {
    return x < low ? x + length : x >= high ? x - length : x;
  }
  Vec3 wrap(Vec3 p) const {
    const Vec3 image{from_next_cell(p.x, low.x, high.x, length.x),
                     from_next_cell(p.y, low.y, high.y, length.y),
                     from_next_cell(p.z, low.z, high.z, length.z)};
    const bool is_inside = image.x >= low.x && image.y >= low.y && image.z >= low.z && image.x < high.x &&
                           image.y < high.y && image.z < high.z;
    return is_inside ? image : box->wrap(p);
  }
  BrickCell brick() const {
    BrickCell cell;
    for (int axis = 0; axis < 3; ++axis) {
      cell.low[axis] = low[axis];
      cell.high[axis] = high[axis];
      cell.length[axis] = length[axis];
      cell.half[axis] = half[axis];
    }
    return cell;
  }
  static double nearest(double d, double length, double half) {
    return d - (d > half ? length : 0.0) + (d < -half ? length : 0.0);
  }
  Vec3 displacement(Vec3 p, Vec3 q) const {
    return {nearest(q.x - p.x, length.x, half.x), nearest(q.y - p.y, length.y, half.y),
            nearest(q.z - p.z, length.z, half.z)};
  }
  double distance2(Vec3 p, Vec3 q) const { return norm2(displacement(p, q)); }

  static constexpr double kOpen = std::numeric_limits<double>::infinity();
  const Box* box;
  Vec3 length{};  ///< 0 along open axes
  Vec3 half{kOpen, kOpen, kOpen};
  Vec3 low{-kOpen, -kOpen, -kOpen}, high{kOpen, kOpen, kOpen};  ///< corners of the cell
};

struct LatticeMetric {
  explicit LatticeMetric(const Box& b) : box(&b) {}
  Vec3 wrap(Vec3 p) const { return box->wrap(p); }
  Vec3 displacement(Vec3 p, Vec3 q) const { return box->nearest_image(q - p); }
  double distance2(Vec3 p, Vec3 q) const { return box->distance2(p, q); }
  const Box* box;
};

/// Calls f with the metric of the box; hot loops are compiled once for each.
template <class F>
decltype(auto) with_metric(const Box& box, F&& f) {
  if (!box.any_periodic()) return f(OpenMetric(box));
  if (box.kind() == Box::Kind::orthorhombic) return f(OrthorhombicMetric(box));
  return f(LatticeMetric(box));
}

}  // namespace dch::detail
