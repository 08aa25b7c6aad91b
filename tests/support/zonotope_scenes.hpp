// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <dch/base/vec3.hpp>

#include "random.hpp"

namespace dch::scenes {

/// Generators on a grid of 2^-20, so that integers are an oracle for them: of any kind that the thesis
/// excludes too.
enum class GeneratorKind {
  generic,
  axes,
  parallel,
  coplanar,
  vertical,
  flat,
  segment,
  few_directions,
  count
};

inline double on_grid(double x, int bits) { return std::ldexp(std::nearbyint(std::ldexp(x, bits)), -bits); }
inline Vec3 on_grid(Vec3 v, int bits) { return {on_grid(v.x, bits), on_grid(v.y, bits), on_grid(v.z, bits)}; }

inline std::vector<Vec3> grid_generators(Random& random, GeneratorKind kind, std::size_t count) {
  std::vector<Vec3> u;
  const Vec3 base = on_grid(random.in_cube(1), 20), second = on_grid(random.in_cube(1), 20);
  const auto factor = [&] { return static_cast<double>(static_cast<int>(random.below(7)) - 3); };
  for (std::size_t k = 0; k < count; ++k) {
    Vec3 v = on_grid(random.in_cube(1), 20);
    const bool odd = k % 2 == 1;
    if (kind == GeneratorKind::axes)
      v = k % 3 == 0 ? Vec3{v.x, 0, 0} : k % 3 == 1 ? Vec3{0, v.y, 0} : Vec3{0, 0, v.z};
    else if (kind == GeneratorKind::parallel && odd && k > 0)
      v = factor() * u[random.below(k)];
    else if (kind == GeneratorKind::coplanar && odd)
      v = factor() * base + factor() * second;
    else if (kind == GeneratorKind::vertical && odd)
      v = {0, 0, v.z};
    else if (kind == GeneratorKind::flat)
      v = factor() * base + factor() * second;
    else if (kind == GeneratorKind::segment)
      v = factor() * base;
    else if (kind == GeneratorKind::few_directions)
      v = {factor(), factor(), factor()};
    u.push_back(v);
  }
  return u;
}

/// A point of the boundary of their sum, on a grid of 2^-40: of a facet of two of the generators that are not
/// parallel, if there are such.
inline Vec3 boundary_point(Random& random, const std::vector<Vec3>& u) {
  const std::size_t i = random.below(u.size()), j = random.below(u.size());
  Vec3 normal = cross(u[i], u[j]);
  if (normal == Vec3{}) normal = random.in_cube(1);
  Vec3 point;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const double w = dot(normal, u[k]);
    // Products that vanish do so exactly only by luck; where they do not, the point is still one of the
    // zonotope.
    const double share = k == i || k == j || std::abs(w) < 1e-12 ? on_grid(random.uniform(-1, 1), 20)
                         : w > 0                                 ? 1
                                                                 : -1;
    point = point + share * u[k];
  }
  return point;
}

}  // namespace dch::scenes
