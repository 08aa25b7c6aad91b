// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <dch/base/error.hpp>
#include <dch/geometry/separating_axes.hpp>

namespace dch {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// Below this share of the largest possible volume three generators count as lying in a plane. It only
/// decides whether more axes are tried.
constexpr double kFlat = 1e-8;

double magnitude(Vec3 a, Vec3 b) { return std::abs(a.x * b.x) + std::abs(a.y * b.y) + std::abs(a.z * b.z); }

class Origin {
 public:
  Origin(Vec3 center, Span<const Vec3> generators, double margin)
      : center_(center), generators_(generators), margin_(margin) {}

  /// Of three products and two sums each, |center . axis| and |g . axis| are off by at most 1.5 epsilon of
  /// the sums of magnitudes, their sum by n/2 epsilon, the length by 2 epsilon; n + 16 covers these twice
  /// over, and what rounding does to the bound itself. What underflows is less than the smallest normal
  /// number each time.
  bool is_beyond(Vec3 axis) const {
    double reach = 0, magnitudes = magnitude(center_, axis);
    for (const Vec3 g : generators_) {
      reach += std::abs(dot(g, axis));
      magnitudes += magnitude(g, axis);
    }
    const auto count = static_cast<double>(generators_.size());
    const double margin = margin_ > 0 ? margin_ * std::sqrt(norm2(axis)) : 0;
    const double error = (count + 16) * (kEpsilon * (magnitudes + margin) +
                                         std::numeric_limits<double>::min() * (1 + margin_));
    return std::abs(dot(center_, axis)) - reach - margin > error;
  }

  bool is_apart() const {
    if (is_beyond(center_)) return true;
    Vec3 normal;  // the longest: that of the plane, if all lie in one
    double longest = 0;
    for (std::size_t j = 1; j < generators_.size(); ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        const Vec3 axis = cross(generators_[i], generators_[j]);
        if (is_beyond(axis)) return true;
        const double length2 = norm2(axis);
        if (length2 > longest) longest = length2, normal = axis;
      }
    }
    return is_flat(normal) && is_apart_in_plane(normal);
  }

 private:
  bool is_flat(Vec3 normal) const {
    double longest = 0, height = 0;
    for (const Vec3 g : generators_) {
      longest = std::max(longest, std::sqrt(norm2(g)));
      height = std::max(height, std::abs(dot(g, normal)));
    }
    return height <= kFlat * longest * std::sqrt(norm2(normal));
  }

  /// A plane has its edges' normals. All generators of a segment are parallel; the plane is that through it
  /// and the center then, and the segment's ends have its direction for a normal.
  bool is_apart_in_plane(Vec3 normal) const {
    const bool is_segment = !std::any_of(generators_.begin(), generators_.end(), [&](Vec3 g) {
      return norm2(normal) > kFlat * kFlat * norm2(g) * norm2(g);
    });
    for (const Vec3 g : generators_) {
      if (is_beyond(cross(normal, g))) return true;
      if (is_segment && (is_beyond(cross(cross(g, center_), g)) || is_beyond(g))) return true;
    }
    return false;
  }

  Vec3 center_;
  Span<const Vec3> generators_;
  double margin_;
};

}  // namespace

bool zonotope_is_apart(Vec3 center, Span<const Vec3> generators, double margin) {
  if (generators.size() > kMaxAxisGenerators) {
    throw InvalidParameter("separating axes are tried for up to " + std::to_string(kMaxAxisGenerators) +
                           " generators; there are " + std::to_string(generators.size()) +
                           "; use a support mapping (GJK), or reduce the zonotope first");
  }
  if (!(margin >= 0) || !std::isfinite(margin)) {
    throw InvalidParameter("the margin is " + std::to_string(margin) +
                           "; it has to be finite and at least 0");
  }
  return Origin(center, generators, margin).is_apart();
}

}  // namespace dch
