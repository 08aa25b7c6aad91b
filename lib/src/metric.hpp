// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include <dch/box.hpp>

namespace dch::detail {

/// Distances between points that Box::wrap has put into the cell. All three are bitwise symmetric in p and q,
/// which the structural predicates rely on: a tie must come out the same from both sides.
struct OpenMetric {
  explicit OpenMetric(const Box&) {}
  static Vec3 displacement(Vec3 p, Vec3 q) { return q - p; }
  static double distance2(Vec3 p, Vec3 q) { return norm2(q - p); }
};

struct OrthorhombicMetric {
  explicit OrthorhombicMetric(const Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!box.periodic(axis)) continue;
      length[axis] = box.vector(axis)[axis];
      half[axis] = 0.5 * length[axis];
    }
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
  Vec3 length{};  ///< 0 along open axes
  Vec3 half{kOpen, kOpen, kOpen};
};

struct LatticeMetric {
  explicit LatticeMetric(const Box& b) : box(&b) {}
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
