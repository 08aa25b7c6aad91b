// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <string>

#include <dch/base/error.hpp>
#include <dch/zonotope/zonogon.hpp>

#include "kink_search.hpp"
#include "predicates.hpp"

namespace dch::zonotope {
namespace {

/// The corners of the hull, counterclockwise, without points within its edges (A. M. Andrew, Inf. Process.
/// Lett. 9:216, 1979). Turns are decided without rounding.
std::vector<Vec2> hull_of(std::vector<Vec2> points, std::int64_t& operations) {
  std::sort(points.begin(), points.end(), [&](Vec2 a, Vec2 b) {
    ++operations;
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 2) return points;
  std::vector<Vec2> hull;
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t start = hull.size();
    for (auto point = first; point != last; ++point) {
      while (hull.size() >= start + 2 && orientation(hull[hull.size() - 2], hull.back(), *point) <= 0) {
        ++operations;
        hull.pop_back();
      }
      ++operations;
      hull.push_back(*point);
    }
    hull.pop_back();  // the other chain begins with it
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

void check_points(Span<const Vec2> points) {
  if (points.empty()) throw InvalidParameter("there are 0 points to enclose by a zonogon; give at least 1");
  for (std::size_t k = 0; k < points.size(); ++k) {
    try {
      check(Zonogon{points[k], {}});
    } catch (const InvalidPosition& error) {
      throw InvalidPosition("point " + std::to_string(k) + " of those to enclose: " + error.what());
    }
  }
}

/// For each edge of the hull the line on which the center is as far from the edge as half of the farthest
/// corner: beyond it the edge is one of the zonogon, too (Lemma 3.4.1). Scaled by its length, which makes the
/// sum of max(0, .) over all edges half of the sum of | . | but for a constant, since the edges add up to 0.
std::vector<KinkLine> halfway_lines(const std::vector<Vec2>& hull, std::int64_t& operations) {
  std::vector<KinkLine> lines;
  const std::size_t n = hull.size();
  std::size_t farthest = 1;
  for (std::size_t t = 0; t < n; ++t) {
    const Vec2 edge = hull[(t + 1) % n] - hull[t];
    while (cross(edge, hull[(farthest + 1) % n] - hull[farthest % n]) > 0) {
      ++farthest;
      ++operations;
    }
    ++operations;
    const Vec2 inward{-edge.y, edge.x};
    lines.push_back({inward.x, inward.y, -0.5 * dot(inward, hull[t] + hull[farthest % n])});
  }
  return lines;
}

Zonogon enclosing(const std::vector<Vec2>& hull, Vec2 center, std::int64_t& operations) {
  std::vector<Vec2> both;
  for (const Vec2& point : hull) {
    const Vec2 offset = point - center;
    both.push_back(offset);
    both.push_back(-1.0 * offset);
  }
  const std::vector<Vec2> around = hull_of(std::move(both), operations);
  Zonogon result{center, {}};
  for (std::size_t k = 0; k + 1 <= around.size() / 2; ++k)  // the other half is opposite
    result.generators.push_back(0.5 * (around[k + 1 < around.size() ? k + 1 : 0] - around[k]));
  return result;
}

}  // namespace

Zonogon enclosing_zonogon(Span<const Vec2> points, Vec2 center) {
  check_points(points);
  check(Zonogon{center, {}});
  std::int64_t operations = 0;
  return enclosing(hull_of({points.begin(), points.end()}, operations), center, operations);
}

Zonogon min_area_zonogon(Span<const Vec2> points, ZonogonStats* stats) {
  check_points(points);
  ZonogonStats unused;
  ZonogonStats& count = stats != nullptr ? *stats : unused;
  std::vector<Vec2> hull = hull_of({points.begin(), points.end()}, count.operations);
  // Around a corner: what rounds is the extent, not the place.
  const Vec2 origin = hull[0], last = hull[hull.size() / 2];
  if (hull.size() <= 2) return enclosing(hull, origin + 0.5 * (last - origin), count.operations);
  std::vector<Vec2> moved;
  moved.reserve(hull.size());
  for (const Vec2& point : hull) moved.push_back(point - origin);
  const KinkMinimum least = least_kinks(halfway_lines(moved, count.operations));
  count.rounds += least.rounds;
  count.operations += least.operations;
  return enclosing(hull, origin + Vec2{least.x, least.y}, count.operations);
}

}  // namespace dch::zonotope
