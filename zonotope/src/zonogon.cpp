// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <dch/zonotope/membership.hpp>
#include <dch/zonotope/zonogon.hpp>
#include <dch/zonotope/zonotope.hpp>

#include "predicates.hpp"

namespace dch::zonotope {
namespace {

Vec3 raised(Vec2 v) { return {v.x, v.y, 0}; }

Zonotope raised(const Zonogon& z) {
  Zonotope result{raised(z.center), {}};
  result.generators.reserve(z.generators.size());
  for (const Vec2& v : z.generators) result.generators.push_back(raised(v));
  return result;
}

Vec2 in_half_plane(Vec2 v) { return v.x < 0 || (v.x == 0 && v.y < 0) ? -1.0 * v : v; }

}  // namespace

void check(const Zonogon& z) { check(raised(z)); }

Zonogon sum(const Zonogon& a, const Zonogon& b) {
  Zonogon result{a.center + b.center, a.generators};
  result.generators.insert(result.generators.end(), b.generators.begin(), b.generators.end());
  return result;
}

Zonogon difference(const Zonogon& a, const Zonogon& b) { return sum(a, {-1.0 * b.center, b.generators}); }

double support(const Zonogon& z, Vec2 direction) {
  double value = dot(direction, z.center);
  for (const Vec2& v : z.generators) value += std::abs(dot(direction, v));
  return value;
}

Vec2 support_point(const Zonogon& z, Vec2 direction) {
  Vec2 point = z.center;
  for (const Vec2& v : z.generators) {
    const double side = dot(direction, v);
    if (side != 0) point = point + (side > 0 ? 1.0 : -1.0) * v;
  }
  return point;
}

Zonogon canonical(const Zonogon& z) {
  check(z);
  Zonogon result{z.center, {}};
  std::vector<Vec2>& v = result.generators;
  for (const Vec2& u : z.generators)
    if (u != Vec2{}) v.push_back(in_half_plane(u));
  std::sort(v.begin(), v.end(), [](Vec2 a, Vec2 b) {
    const int side = sign_of_cross(a, b);
    return side != 0 ? side > 0 : dot(a, a) < dot(b, b);
  });
  std::size_t count = 0;
  Vec2 last;
  for (const Vec2 u : v) {
    if (count > 0 && sign_of_cross(last, u) == 0)
      v[count - 1] = v[count - 1] + u;
    else
      v[count++] = u;
    last = u;
  }
  v.resize(count);
  return result;
}

double area(const Zonogon& z) {
  double sum = 0;
  Vec2 before;
  for (const Vec2& v : canonical(z).generators) {
    sum += cross(before, v);
    before = before + v;
  }
  return 4 * sum;
}

std::vector<Vec2> vertices(const Zonogon& z) {
  const Zonogon sorted = canonical(z);
  std::vector<Vec2> result;
  Vec2 corner = sorted.center;
  for (const Vec2& v : sorted.generators) corner = corner - v;
  if (sorted.generators.empty()) return {corner};
  for (const double sign : {2.0, -2.0})
    for (const Vec2& v : sorted.generators) {
      result.push_back(corner);
      corner = corner + sign * v;
    }
  return result;
}

// As prisms, which are no flat zonotopes: what is decided in doubles for those needs no numbers without
// rounding.
bool contains(const Zonogon& z, Vec2 point) {
  Zonotope prism = raised(z);
  prism.generators.push_back({0, 0, 1});
  return contains(prism, raised(point));
}

bool intersect(const Zonogon& a, const Zonogon& b) {
  Zonotope prism = raised(a);
  prism.generators.push_back({0, 0, 1});
  return intersect(prism, raised(b));
}

}  // namespace dch::zonotope
