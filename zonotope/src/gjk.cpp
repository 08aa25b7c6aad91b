// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <dch/zonotope/gjk.hpp>

#include "gjk_search.hpp"
#include "membership_question.hpp"
#include "predicates.hpp"

namespace dch::zonotope {
namespace {

constexpr int kIterations = 200;  // GJK takes a dozen; more would be the endless loop of rounding

/// Of the vertices, less the point, the one that is least along a direction.
Vec3 lowest_vertex(const Question& question, Vec3 direction) {
  Vec3 vertex{-question.point.x, -question.point.y, -question.point.z};
  for (const Vec3& u : question.generators) vertex = vertex - (dch::dot(direction, u) >= 0 ? 1.0 : -1.0) * u;
  return vertex;
}

double size_of(const Question& question) {
  Vec3 sum = magnitudes(question.point);
  for (const Vec3& u : question.generators) sum = sum + magnitudes(u);
  return std::max({sum.x, sum.y, sum.z});
}

}  // namespace

ClosestPoint closest_point(const Question& question, Vec3 start, bool decided_only) {
  ClosestPoint result;
  const double size = size_of(question), nothing = 4 * kRounding * size;
  // Towards the origin from where the point is, unless the caller knows better.
  Vec3 to = start != Vec3{} ? Vec3{-start.x, -start.y, -start.z}
                            : Vec3{-question.point.x, -question.point.y, -question.point.z};
  if (to == Vec3{}) to = {1, 0, 0};
  double least = INFINITY;
  while (result.iterations < kIterations) {
    const double length = std::sqrt(norm2(to));
    if (!(length > 0)) break;  // squares underflow
    const Vec3 direction = 1 / length * to, vertex = lowest_vertex(question, direction);
    ++result.iterations;
    result.last_direction = direction;
    const double bound = dch::dot(direction, vertex);
    result.lower_bound = std::max(result.lower_bound, bound);
    if (decided_only && bound > nothing && is_separated(question, direction)) break;
    if (result.simplex.count > 0) {
      if (length - bound <= 1e-13 * length) break;
      const auto begin = result.simplex.points.cbegin(), end = begin + result.simplex.count;
      if (std::find(begin, end, vertex) != end) break;
    }
    result.simplex.add(vertex, direction);
    to = result.simplex.reduce();
    result.from_point = to;
    const double now = std::sqrt(norm2(to));
    if (!(now > nothing)) {
      result.from_point = {};
      result.lower_bound = 0;
      break;
    }
    if (!(now < least)) break;  // rounding leads it in a circle
    least = now;
    if (result.simplex.count == 4) break;
  }
  return result;
}

bool is_in_simplex(const Question& question, const Simplex& simplex) {
  if (simplex.count != 4) return false;
  Vec3 sizes = magnitudes(question.point) + magnitudes(question.tail);
  for (const Vec3& u : question.generators) sizes = sizes + magnitudes(u);
  const double size = std::max({sizes.x, sizes.y, sizes.z});
  const Vec3 last = magnitudes(question.tail);
  // An error of each coordinate of a vertex; then of a determinant of three edges, of at most 2 size each.
  const double of_vertex = (2 * static_cast<double>(question.generators.size()) + 16) * kRounding * size +
                           std::max({last.x, last.y, last.z});
  const double error = 200 * size * size * of_vertex;
  const auto& p = simplex.points;
  const auto det = [](Vec3 a, Vec3 b, Vec3 c) { return dch::dot(dch::cross(a, b), c); };
  const double all = det(p[1] - p[0], p[2] - p[0], p[3] - p[0]), sign = all > 0 ? 1 : -1;
  const double parts[4] = {det(p[1], p[2], p[3]), -det(p[0], p[2], p[3]), det(p[0], p[1], p[3]),
                           -det(p[0], p[1], p[2])};
  return std::abs(all) > error + kSmallest &&
         std::all_of(std::begin(parts), std::end(parts), [&](double part) { return sign * part > error; });
}

Separation distance(const Zonotope& a, const Zonotope& b, Vec3 start) {
  const Question question = question_of_two(a, b);
  const ClosestPoint closest = closest_point(question, start, false);
  Separation result;
  result.iterations = closest.iterations;
  result.point_a = a.center;
  result.point_b = b.center;
  // The same mean of the vertices, of each zonotope for itself.
  for (int k = 0; k < closest.simplex.count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    for (const Vec3& u : a.generators)
      result.point_a = result.point_a - closest.simplex.weights[at] *
                                            (dch::dot(closest.simplex.directions[at], u) >= 0 ? 1.0 : -1.0) *
                                            u;
    for (const Vec3& u : b.generators)
      result.point_b = result.point_b + closest.simplex.weights[at] *
                                            (dch::dot(closest.simplex.directions[at], u) >= 0 ? 1.0 : -1.0) *
                                            u;
  }
  result.distance = std::sqrt(norm2(closest.from_point));
  result.lower_bound = std::min(closest.lower_bound, result.distance);
  if (result.distance > 0) result.direction = -1 / result.distance * closest.from_point;
  return result;
}

}  // namespace dch::zonotope
