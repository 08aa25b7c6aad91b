// SPDX-License-Identifier: MIT
#include "simplex.hpp"

#include <limits>

namespace dch::zonotope {
namespace {

using Weights = std::array<double, 4>;

/// The weights of the point closest to the origin in the plane, line or space through `count` points; false
/// if the points are in a space of fewer dimensions. Cramer's rule.
bool affine_weights(const std::array<Vec3, 4>& p, int count, Weights& weights) {
  weights = {1, 0, 0, 0};
  if (count == 1) return true;
  const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0], to{-p[0].x, -p[0].y, -p[0].z};
  if (count == 2) {
    const double square = norm2(a);
    if (!(square > 0)) return false;
    weights[1] = dot(a, to) / square;
  } else if (count == 3) {
    const Vec3 normal = cross(a, b);
    const double square = norm2(normal);
    if (!(square > 1e-28 * norm2(a) * norm2(b))) return false;
    weights[1] = dot(cross(to, b), normal) / square;
    weights[2] = dot(cross(a, to), normal) / square;
  } else {
    const double det = dot(cross(a, b), c);
    if (!(det * det > 1e-28 * norm2(a) * norm2(b) * norm2(c))) return false;
    weights[1] = dot(cross(to, b), c) / det;
    weights[2] = dot(cross(a, to), c) / det;
    weights[3] = dot(cross(a, b), to) / det;
  }
  weights[0] = 1 - weights[1] - weights[2] - weights[3];
  return true;
}

}  // namespace

void Simplex::add(Vec3 point, Vec3 direction) {
  points[static_cast<std::size_t>(count)] = point;
  directions[static_cast<std::size_t>(count)] = direction;
  ++count;
}

Vec3 Simplex::reduce() {
  Simplex best;
  Vec3 closest;
  double least = std::numeric_limits<double>::infinity();
  for (unsigned subset = 1; subset < 1u << count; ++subset) {
    Simplex part;
    for (int k = 0; k < count; ++k)
      if ((subset >> k & 1u) != 0)
        part.add(points[static_cast<std::size_t>(k)], directions[static_cast<std::size_t>(k)]);
    if (!affine_weights(part.points, part.count, part.weights)) continue;
    bool is_within = true;
    Vec3 at;
    for (int k = 0; k < part.count; ++k) {
      const double weight = part.weights[static_cast<std::size_t>(k)];
      is_within = is_within && weight >= 0;
      at = at + weight * part.points[static_cast<std::size_t>(k)];
    }
    if (part.count == 4) at = {};
    if (!is_within || !(norm2(at) < least)) continue;
    least = norm2(at);
    closest = at;
    best = part;
  }
  *this = best;
  return closest;
}

}  // namespace dch::zonotope
