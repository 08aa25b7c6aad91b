// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

#include "random.hpp"

/// Point sets and boxes that every engine has to get right, all deterministic functions of their arguments.
namespace dch::scenes {

struct NamedBox {
  std::string name;  ///< letters, digits and underscores, as names of tests need
  Box box;
};

inline std::ostream& operator<<(std::ostream& out, const NamedBox& box) { return out << box.name; }

struct NamedPoints {
  std::string name;
  std::vector<Vec3> points;
};

/// Side of the cube that stands for the cell where there is none [length].
inline constexpr double kOpenSide = 5;

/// One box of each kind with edges of about `size`.
inline std::vector<NamedBox> all_boxes(double size) {
  const double s = size, root2 = std::sqrt(2.0), root6 = std::sqrt(6.0);
  const Vec3 a{s, 0, 0}, b{0.3 * s, 1.1 * s, 0}, c{-0.4 * s, 0.35 * s, 0.95 * s};
  const Vec3 corner{-0.5 * s, 0.25 * s, 3 * s};
  return {
      {"none", Box::none()},
      {"orthorhombic_ppp", Box::orthorhombic({s, 1.2 * s, 0.9 * s})},
      {"orthorhombic_ppf", Box::orthorhombic({s, 1.1 * s, 0.9 * s}, {true, true, false}, corner)},
      {"orthorhombic_pff", Box::orthorhombic({s, s, s}, {true, false, false})},
      {"triclinic_ppp", Box::triclinic(a, b, c, {true, true, true}, corner)},
      {"triclinic_ppf", Box::triclinic(a, b, c, {true, true, false})},
      {"skewed", Box::triclinic(a, b + 4.0 * a, c - 7.0 * a + 3.0 * b)},
      {"truncated_octahedron",
       Box::triclinic({s, 0, 0}, {s / 3, 2 * root2 / 3 * s, 0}, {-s / 3, root2 / 3 * s, root6 / 3 * s})},
      {"rhombic_dodecahedron", Box::triclinic({s, 0, 0}, {0, s, 0}, {0.5 * s, 0.5 * s, 0.5 * root2 * s})},
  };
}

/// The point with the given fractional coordinates.
inline Vec3 from_fractional(const Box& box, Vec3 f) {
  if (box.kind() == Box::Kind::none) return kOpenSide * f;
  return box.origin() + (f.x * box.vector(0) + f.y * box.vector(1) + f.z * box.vector(2));
}

/// n points, uniform in [0, lengths).
inline std::vector<Vec3> uniform(std::size_t n, Vec3 lengths, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points(n);
  for (Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = random.uniform(0, lengths[axis]);
  }
  return points;
}

/// n points, uniform in the cell.
inline std::vector<Vec3> uniform_in(const Box& box, std::size_t n, std::uint64_t seed) {
  auto points = uniform(n, {1, 1, 1}, seed);
  for (Vec3& p : points) p = from_fractional(box, p);
  return points;
}

/// n points about eight centers, at distances from half the cell down to a thousandth of that: density varies
/// by nine decades. Some lie outside the cell.
inline std::vector<Vec3> clustered(const Box& box, std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const auto centers = uniform(8, {1, 1, 1}, seed + 1);
  std::vector<Vec3> points(n);
  for (Vec3& p : points) {
    const double reach = std::ldexp(0.5, -static_cast<int>(random.below(11)));
    const Vec3 off =
        random.in_ball(reach);  // before the center: which operand comes first is up to compilers
    p = from_fractional(box, centers[random.below(centers.size())] + off);
  }
  return points;
}

/// n points on a line along x, `spacing` apart, in random order.
inline std::vector<Vec3> collinear(const Box& box, std::size_t n, double spacing, std::uint64_t seed) {
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < n; ++k) {
    points.push_back(box.origin() + Vec3{spacing * static_cast<double>(k), 0, 0});
  }
  Random(seed).shuffle(points);
  return points;
}

/// n points on one spot inside the cell.
inline std::vector<Vec3> coincident(const Box& box, std::size_t n) {
  return std::vector<Vec3>(n, from_fractional(box, {0.3, 0.6, 0.1}));
}

/// n - 1 points uniform in the cell and one at x = 1e12.
inline std::vector<Vec3> one_far(const Box& box, std::size_t n, std::uint64_t seed) {
  auto points = uniform_in(box, n, seed);
  if (!points.empty()) points.back().x = 1e12;
  return points;
}

/// Face-centered cubic sites with the given nearest-neighbor distance, layer by layer, at most n: as many
/// conventional cells along each axis as the cell vector is long. Ties at every distance.
inline std::vector<Vec3> fcc(const Box& box, double spacing,
                             std::size_t n = std::numeric_limits<std::size_t>::max()) {
  const double half = spacing / std::sqrt(2.0);  // conventional cells have twice this side
  int layers[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double length = box.kind() == Box::Kind::none ? kOpenSide : std::sqrt(norm2(box.vector(axis)));
    layers[axis] = 2 * std::max(1, static_cast<int>(length / (2 * half)));
  }
  std::vector<Vec3> points;
  for (int z = 0; z < layers[2]; ++z) {
    for (int y = 0; y < layers[1]; ++y) {
      for (int x = (y + z) % 2; x < layers[0] && points.size() < n; x += 2) {
        points.push_back(box.origin() + Vec3{half * x, half * y, half * z});
      }
    }
  }
  return points;
}

/// Points on the faces, edges and corners of the cell, a rounding error off them, and many cells away from
/// it.
inline std::vector<Vec3> boundary(const Box& box, std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double special[] = {0, 1, -1e-17, 1e-17, 1 - 1e-16, 1 + 1e-15, 0.5, -1, 2, -1000, 1000.5};
  std::vector<Vec3> points(n);
  for (Vec3& p : points) {
    Vec3 f;
    for (int axis = 0; axis < 3; ++axis) {
      f[axis] = random.uniform() < 0.5 ? random.uniform() : special[random.below(std::size(special))];
    }
    p = from_fractional(box, f);
  }
  return points;
}

/// One point set of each kind, of n points each (fcc: at most n).
inline std::vector<NamedPoints> hard_point_sets(const Box& box, std::size_t n, double spacing) {
  return {
      {"uniform", uniform_in(box, n, 101)},           {"clustered", clustered(box, n, 102)},
      {"collinear", collinear(box, n, spacing, 103)}, {"coincident", coincident(box, n)},
      {"one far point", one_far(box, n, 104)},        {"fcc", fcc(box, spacing, n)},
      {"on the boundary", boundary(box, n, 105)},
  };
}

}  // namespace dch::scenes
