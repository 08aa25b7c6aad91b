// SPDX-License-Identifier: MIT
#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <vector>

#include <dch/zonotope/zonogon.hpp>

#include "effort.hpp"
#include "random.hpp"

namespace dch::zonotope {
namespace {

using Rational = boost::multiprecision::cpp_rational;
struct RationalPoint {
  Rational x, y;
};

Rational turn(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Twice the area of the hull, by gift wrapping.
Rational hull_area(const std::vector<RationalPoint>& points) {
  std::size_t first = 0;
  for (std::size_t k = 1; k < points.size(); ++k)
    if (points[k].x < points[first].x || (points[k].x == points[first].x && points[k].y < points[first].y))
      first = k;
  Rational sum = 0;
  std::size_t at = first;
  do {
    std::size_t next = at == 0 ? 1 : 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k == at) continue;
      const Rational side = turn(points[at], points[next], points[k]);
      const auto far = [&](std::size_t p) {
        return abs(points[p].x - points[at].x) + abs(points[p].y - points[at].y);
      };
      if (side < 0 || (side == 0 && far(k) > far(next))) next = k;
    }
    sum += turn(points[first], points[at], points[next]);
    at = next;
  } while (at != first);
  return sum;
}

Rational area_around(const std::vector<RationalPoint>& points, const RationalPoint& center) {
  std::vector<RationalPoint> both = points;
  for (const RationalPoint& p : points) both.push_back({2 * center.x - p.x, 2 * center.y - p.y});
  return hull_area(both) / 2;
}

/// The least area over all vertices of the arrangement of the lines on which the center is halfway from an
/// edge of the hull, any pair of points with all others on one side, to the farthest point.
Rational least_area(const std::vector<RationalPoint>& p) {
  struct Line {
    Rational a, b, c;
  };
  std::vector<Line> lines;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < p.size(); ++j) {
      Rational farthest = 0;
      bool is_edge = i != j;
      for (std::size_t k = 0; k < p.size() && is_edge; ++k) {
        const Rational side = turn(p[i], p[j], p[k]);
        is_edge = side >= 0;
        farthest = std::max(farthest, side);
      }
      if (!is_edge) continue;
      const Rational a = p[i].y - p[j].y, b = p[j].x - p[i].x;
      lines.push_back({a, b, a * p[i].x + b * p[i].y + farthest / 2});
    }
  Rational least = -1;
  for (std::size_t s = 0; s < lines.size(); ++s)
    for (std::size_t t = 0; t < s; ++t) {
      const Rational det = lines[s].a * lines[t].b - lines[s].b * lines[t].a;
      if (det == 0) continue;
      const RationalPoint center{(lines[s].c * lines[t].b - lines[s].b * lines[t].c) / det,
                                 (lines[s].a * lines[t].c - lines[s].c * lines[t].a) / det};
      const Rational area = area_around(p, center);
      if (least < 0 || area < least) least = area;
    }
  return least;
}

std::vector<Vec2> some_points(scenes::Random& random, int count, int kind) {
  std::vector<Vec2> points;
  for (int k = 0; k < count; ++k) {
    Vec2 p{std::ldexp(std::nearbyint(random.uniform(-1, 1) * 1024), -10),
           std::ldexp(std::nearbyint(random.uniform(-1, 1) * 1024), -10)};
    if (kind == 1) p = {std::nearbyint(3 * p.x), std::nearbyint(3 * p.y)};  // many parallel edges
    if (kind == 2) {
      const double angle = random.uniform(0, 6.283);
      p = {std::cos(angle), 0.3 * std::sin(angle)};
    }
    points.push_back(p);
  }
  return points;
}

TEST(LeastZonogon, HasTheAreaOfTheBestVertexInRationals) {
  scenes::Random random(31);
  int compared = 0;
  for (int n = 0; n < effort(60); ++n) {
    const std::vector<Vec2> points = some_points(random, 3 + static_cast<int>(random.below(5)), n % 3);
    std::vector<RationalPoint> exact;
    for (const Vec2 p : points) exact.push_back({Rational(p.x), Rational(p.y)});
    const auto least = static_cast<double>(least_area(exact));
    if (least < 0) continue;  // points on a line
    ++compared;
    const Zonogon found = min_area_zonogon(points);
    EXPECT_NEAR(area(found), least, 1e-13 * least) << n;
    for (const Vec2 p : points) {
      Zonogon wider = found;
      for (Vec2& v : wider.generators) v = (1 + 1e-14) * v;
      wider.generators.push_back({1e-14, 0});
      wider.generators.push_back({0, 1e-14});
      EXPECT_TRUE(contains(wider, p));
    }
  }
  EXPECT_GT(compared, effort(60) / 2);
}

TEST(LeastZonogon, NoCenterIsBetterThanTheOneFound) {
  // A plain minimiser: the pattern of a compass, halved wherever no direction is better. f is convex.
  scenes::Random random(32);
  for (int n = 0; n < effort(30); ++n) {
    const std::vector<Vec2> points = some_points(random, 10 + static_cast<int>(random.below(40)), n % 3);
    const Zonogon found = min_area_zonogon(points);
    Vec2 center{0.1, 0.1};
    double least = area(enclosing_zonogon(points, center));
    for (double step = 1; step > 1e-9;) {
      bool is_better = false;
      for (int k = 0; k < 16; ++k) {
        const Vec2 trial = center + step * Vec2{std::cos(0.3927 * k), std::sin(0.3927 * k)};
        const double now = area(enclosing_zonogon(points, trial));
        if (now < least) least = now, center = trial, is_better = true;
      }
      if (!is_better) step /= 2;
    }
    EXPECT_LE(area(found), least * (1 + 1e-12)) << n;
    EXPECT_GE(area(found), least * (1 - 1e-2)) << "the minimiser is far off";
  }
}

TEST(LeastZonogon, TheAreaIsConvexAndAsTheFormulaSays) {
  scenes::Random random(33);
  const std::vector<Vec2> triangle{{0, 0}, {5, 1}, {2, 4}};
  for (int n = 0; n < 200; ++n) {
    const Vec2 a{random.uniform(-3, 8), random.uniform(-3, 8)};
    // f(O) = C + sum of 2 L max(0, n . O - m), C twice the area of a triangle.
    double expected = std::abs(cross(triangle[1], triangle[2]));
    for (std::size_t t = 0; t < 3; ++t) {
      const Vec2 p = triangle[t], q = triangle[(t + 1) % 3], far = triangle[(t + 2) % 3];
      expected += 2 * std::max(0.0, cross(q - p, a - p) - 0.5 * cross(q - p, far - p));
    }
    EXPECT_NEAR(area(enclosing_zonogon(triangle, a)), expected, 1e-12 * expected);
  }
}

TEST(LeastZonogon, TakesNLogSquaredN) {
  scenes::Random random(34);
  double least = INFINITY, most = 0;
  for (int n = 64; n <= 8192; n *= 2) {
    ZonogonStats stats;
    std::vector<Vec2> points;
    for (int k = 0; k < n; ++k) {  // all on the hull: edges of random directions, one after the other
      const double angle = 6.283185307179586 * (k + 0.4 * random.uniform()) / n;
      points.push_back({std::cos(angle) + 0.2 * std::cos(2 * angle), std::sin(angle)});
    }
    min_area_zonogon(points, &stats);
    const double lg = std::log2(n), ratio = static_cast<double>(stats.operations) / (n * lg * lg);
    std::printf("n = %d: %.2f n lg^2 n operations, %d rounds\n", n, ratio, stats.rounds);
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  EXPECT_LT(most, 3 * least);
  EXPECT_LT(most, 20);
}

}  // namespace
}  // namespace dch::zonotope
