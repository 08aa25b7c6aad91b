// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include <dch/base/error.hpp>
#include <dch/zonotope/faces.hpp>

#include "base/describe.hpp"
#include "predicates.hpp"
#include "vectors.hpp"

namespace dch::zonotope {
namespace {

/// A generator beside another one that is looked along, turned to the side of a first one.
struct Spoke {
  std::size_t index;
  Vec3 vector;
};

/// Of two generators in one plane with an axis: whether they are on the same side of it, 1, or not, -1. Their
/// products with the axis have one direction, so that any coordinate tells in which no product is 0.
int same_side(Vec3 axis, Vec3 a, Vec3 b) {
  for (const int k : {0, 1, 2}) {
    const int next = (k + 1) % 3;
    const Vec2 flat{axis[k], axis[next]};
    const int side = sign_of_cross(flat, {a[k], a[next]}) * sign_of_cross(flat, {b[k], b[next]});
    if (side != 0) return side;
  }
  return 1;
}

/// The generators around one of them, by angle within half a turn from the first.
std::vector<Spoke> spokes_around(const std::vector<Vec3>& v, std::size_t axis) {
  std::vector<Spoke> spokes;
  const std::size_t first = axis == 0 ? 1 : 0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (k == axis) continue;
    int side = sign_of_det(v[axis], v[first], v[k]);
    if (side == 0) side = same_side(v[axis], v[first], v[k]);
    spokes.push_back({k, side * v[k]});
  }
  const auto comes_first = [&](const Spoke& a, const Spoke& b) {
    const bool flat_a = sign_of_det(v[axis], v[first], a.vector) == 0,
               flat_b = sign_of_det(v[axis], v[first], b.vector) == 0;
    if (flat_a || flat_b) return flat_a && !flat_b;
    return sign_of_det(v[axis], a.vector, b.vector) > 0;
  };
  std::sort(spokes.begin(), spokes.end(), comes_first);
  return spokes;
}

void add_facets_of(const Zonotope& z, std::size_t axis, std::vector<Facet>& result) {
  const std::vector<Vec3>& v = z.generators;
  const std::vector<Spoke> spokes = spokes_around(v, axis);
  Vec3 offset;  // from the center to the facet: what is after the plane, less what is before
  for (const Spoke& spoke : spokes) offset = offset + spoke.vector;
  for (std::size_t first = 0, last = 0; first < spokes.size(); first = last) {
    Vec3 of_plane;
    bool is_owner = true;
    for (; last < spokes.size() &&
           (last == first || sign_of_det(v[axis], spokes[first].vector, spokes[last].vector) == 0);
         ++last) {
      of_plane = of_plane + spokes[last].vector;
      is_owner = is_owner && axis < spokes[last].index;
    }
    offset = offset - of_plane;
    if (is_owner) {
      Facet facet{z.center + offset, dch::cross(v[axis], spokes[first].vector), {axis}};
      for (std::size_t k = first; k < last; ++k) facet.generators.push_back(spokes[k].index);
      std::sort(facet.generators.begin(), facet.generators.end());
      result.push_back(facet);
      facet.center = z.center - offset;
      facet.normal = -1.0 * facet.normal;
      result.push_back(std::move(facet));
    }
    offset = offset - of_plane;
  }
}

void check_canonical(const Zonotope& z) {
  check(z);
  const Zonotope merged = canonical(z);
  if (merged.generators.size() == z.generators.size()) return;
  throw InvalidParameter(std::to_string(z.generators.size()) + " generators have " +
                         std::to_string(merged.generators.size()) +
                         " directions: some are parallel or 0; give canonical() of the zonotope");
}

}  // namespace

std::vector<Facet> facets(const Zonotope& z) {
  check_canonical(z);
  std::vector<Facet> result;
  if (z.generators.size() < 2) return result;
  for (std::size_t axis = 0; axis < z.generators.size(); ++axis) add_facets_of(z, axis, result);
  return result;
}

std::vector<Vec3> corners(const Zonotope& z, const Facet& facet) {
  // All turned to one side of the plane's first one, then by angle: half of the way around, and back.
  std::vector<Vec3> around;
  const Vec3 first = z.generators.at(facet.generators.at(0));
  for (const std::size_t k : facet.generators) {
    const Vec3 v = z.generators.at(k);
    around.push_back(dch::dot(dch::cross(first, v), facet.normal) < 0 ? -1.0 * v : v);
  }
  std::sort(around.begin() + 1, around.end(),
            [&](Vec3 a, Vec3 b) { return dch::dot(dch::cross(a, b), facet.normal) > 0; });
  std::vector<Vec3> result;
  Vec3 corner = facet.center;
  for (const Vec3& v : around) corner = corner - v;
  for (const double sign : {2.0, -2.0})
    for (const Vec3& v : around) {
      result.push_back(corner);
      corner = corner + sign * v;
    }
  return result;
}

FaceCounts count_faces(const std::vector<Facet>& facets) {
  FaceCounts counts;
  for (const Facet& facet : facets) counts.edges += static_cast<std::int64_t>(facet.generators.size());
  counts.facets = static_cast<std::int64_t>(facets.size());
  if (counts.facets > 0) counts.vertices = counts.edges - counts.facets + 2;
  return counts;
}

}  // namespace dch::zonotope
