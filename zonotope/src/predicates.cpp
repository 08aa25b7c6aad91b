// SPDX-License-Identifier: MIT
#include "predicates.hpp"

#include <algorithm>
#include <cmath>

#include "exact.hpp"

namespace dch::zonotope {

int sign_of_cross(Vec2 a, Vec2 b) {
  // Rounding is monotone: where the rounded products differ, they differ as the products do.
  const double left = a.x * b.y, right = a.y * b.x;
  if (left > right && (left > kSmallest || right < -kSmallest)) return 1;
  if (left < right && (right > kSmallest || left < -kSmallest)) return -1;
  if (left == right && std::abs(left) > 1e-250)
    return sign_of(std::fma(a.x, b.y, -left) - std::fma(a.y, b.x, -right));
  return (Exact(a.x) * b.y - Exact(a.y) * b.x).sign();
}

int sign_of_det(Vec3 a, Vec3 b, Vec3 c) {
  const double det = dot(dch::cross(a, b), c);
  const Vec3 p = magnitudes(a), q = magnitudes(b), r = magnitudes(c);
  const double permanent =
      (p.y * q.z + p.z * q.y) * r.x + (p.z * q.x + p.x * q.z) * r.y + (p.x * q.y + p.y * q.x) * r.z;
  if (std::abs(det) > 16 * kRounding * permanent + kSmallest) return sign_of(det);
  return dot(cross(exact(a), exact(b)), exact(c)).sign();
}

int orientation(Vec2 a, Vec2 b, Vec2 c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
  if (std::abs(left - right) > 8 * kRounding * (std::abs(left) + std::abs(right)) + kSmallest)
    return sign_of(left - right);
  const Exact x = a.x, y = a.y;
  return ((Exact(b.x) - x) * (Exact(c.y) - y) - (Exact(b.y) - y) * (Exact(c.x) - x)).sign();
}

bool span_space(const std::vector<Vec3>& vectors) {
  const auto first = std::find_if(vectors.begin(), vectors.end(), [](Vec3 v) { return v != Vec3{}; });
  if (first == vectors.end()) return false;
  const auto second = std::find_if(first, vectors.end(), [&](Vec3 v) { return !are_parallel(*first, v); });
  return std::any_of(second, vectors.end(), [&](Vec3 v) { return sign_of_det(*first, *second, v) != 0; });
}

bool are_parallel(Vec3 a, Vec3 b) {
  return sign_of_cross({a.x, a.y}, {b.x, b.y}) == 0 && sign_of_cross({a.y, a.z}, {b.y, b.z}) == 0 &&
         sign_of_cross({a.z, a.x}, {b.z, b.x}) == 0;
}

}  // namespace dch::zonotope
