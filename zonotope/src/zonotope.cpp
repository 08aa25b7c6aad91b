// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <dch/base/error.hpp>
#include <dch/zonotope/zonotope.hpp>

#include "base/describe.hpp"
#include "directions.hpp"
#include "predicates.hpp"

namespace dch::zonotope {
namespace {

void check_vector(Vec3 v, const char* what, std::size_t index) {
  const Vec3 m = magnitudes(v);
  if (m.x <= kMaxMagnitude && m.y <= kMaxMagnitude && m.z <= kMaxMagnitude) return;
  throw InvalidPosition(std::string(what) + (index == SIZE_MAX ? "" : " " + std::to_string(index)) + " = " +
                        detail::describe(v) + " of a zonotope is not finite or beyond " +
                        detail::describe(kMaxMagnitude) +
                        "; check the coordinates or use another unit of length");
}

std::vector<Vec3> joined(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<Vec3> both;
  both.reserve(a.size() + b.size());
  both.insert(both.end(), a.begin(), a.end());
  both.insert(both.end(), b.begin(), b.end());
  return both;
}

}  // namespace

void check(const Zonotope& z) {
  check_vector(z.center, "center", SIZE_MAX);
  for (std::size_t k = 0; k < z.generators.size(); ++k) check_vector(z.generators[k], "generator", k);
}

Zonotope sum(const Zonotope& a, const Zonotope& b) {
  return {a.center + b.center, joined(a.generators, b.generators)};
}

Zonotope difference(const Zonotope& a, const Zonotope& b) {
  return {a.center - b.center, joined(a.generators, b.generators)};
}

double support(const Zonotope& z, Vec3 direction) {
  double value = dot(direction, z.center);
  for (const Vec3& v : z.generators) value += std::abs(dot(direction, v));
  return value;
}

Vec3 support_point(const Zonotope& z, Vec3 direction) {
  Vec3 point = z.center;
  for (const Vec3& v : z.generators) point = point + sign_of(dot(direction, v)) * v;
  return point;
}

double volume(const Zonotope& z) {
  check(z);
  const std::vector<Vec3>& v = z.generators;
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 normal = dch::cross(v[i], v[j]);
      for (std::size_t k = 0; k < j; ++k) sum += std::abs(dot(normal, v[k]));
    }
  return 8 * sum;
}

double surface_area(const Zonotope& z) {
  check(z);
  const std::vector<Vec3>& v = z.generators;
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) sum += std::sqrt(norm2(dch::cross(v[i], v[j])));
  return 8 * sum;
}

Zonotope canonical(const Zonotope& z) {
  check(z);
  Zonotope result{z.center, {}};
  for (const Vec3& v : z.generators)
    if (v != Vec3{}) result.generators.push_back(in_half_space(v));
  std::vector<Vec3>& v = result.generators;
  // Those of one direction by length, so that their sum does not depend on the order given.
  std::sort(v.begin(), v.end(), [](Vec3 a, Vec3 b) {
    const int order = compare_directions(a, b);
    return order != 0 ? order < 0 : norm2(a) < norm2(b);
  });
  std::size_t count = 0;
  Vec3 last;  // as given: sums are rounded
  for (const Vec3 u : v) {
    if (count > 0 && compare_directions(last, u) == 0)
      v[count - 1] = v[count - 1] + u;
    else
      v[count++] = u;
    last = u;
  }
  v.resize(count);
  return result;
}

}  // namespace dch::zonotope
