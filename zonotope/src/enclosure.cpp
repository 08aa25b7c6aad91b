// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <dch/zonotope/membership.hpp>

#include "exact.hpp"
#include "membership_question.hpp"
#include "predicates.hpp"

namespace dch::zonotope {
namespace {

/// The generators of both, and the difference of the centers.
struct Pair {
  std::vector<Vec3> outer, inner;
  Question centers;
  Vec3 sizes;  ///< sums of magnitudes over all of them

  double roundings() const { return (2 * static_cast<double>(outer.size() + inner.size()) + 64) * kRounding; }
};

template <class Vector>
auto rest_along(const std::vector<Vec3>& outer, const std::vector<Vec3>& inner, const Vector& normal,
                const Vector& offset, Vector (*number)(Vec3)) {
  auto rest = dot(normal, offset);
  if (sign_of(rest) > 0) rest = -rest;
  for (const Vec3& u : outer) {
    const auto w = dot(normal, number(u));
    rest = sign_of(w) < 0 ? rest - w : rest + w;
  }
  for (const Vec3& u : inner) {
    const auto w = dot(normal, number(u));
    rest = sign_of(w) < 0 ? rest + w : rest - w;
  }
  return rest;
}

bool reaches_exactly(const Pair& pair, const ExactVec& normal) {
  return rest_along<ExactVec>(pair.outer, pair.inner, normal, pair.centers.exact_point(), exact).sign() >= 0;
}

bool reaches(const Pair& pair, Vec3 a, Vec3 b) {
  const Vec3 normal = dch::cross(a, b), p = magnitudes(a), q = magnitudes(b);
  const Vec3 permanents{p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x};
  const double rest =
      rest_along<Vec<double>>(pair.outer, pair.inner, rounded(normal), rounded(pair.centers.point), rounded);
  const double bound = pair.roundings() * dch::dot(permanents, pair.sizes) + kSmallest;
  if (std::abs(rest) > bound) return rest > 0;
  return reaches_exactly(pair, cross(exact(a), exact(b)));
}

/// Of an outer zonotope that is a segment or a point, at most: perpendiculars, and its own direction.
bool segment_encloses(const Pair& pair) {
  const ExactVec axes[3] = {exact({1, 0, 0}), exact({0, 1, 0}), exact({0, 0, 1})};
  return std::all_of(std::begin(axes), std::end(axes), [&](const ExactVec& axis) {
    if (pair.outer.empty()) return reaches_exactly(pair, axis);
    return reaches_exactly(pair, cross(exact(pair.outer[0]), axis)) &&
           reaches_exactly(pair, exact(pair.outer[0]));
  });
}

}  // namespace

bool encloses(const Zonotope& outer, const Zonotope& inner) {
  Pair pair;
  pair.outer = question_of_two(outer, {}).generators;  // those that are not 0
  pair.inner = question_of_two(inner, {}).generators;
  pair.centers = question_of_two({outer.center, {}}, {inner.center, {}});
  pair.sizes = magnitudes(pair.centers.point) + magnitudes(pair.centers.tail);
  for (const auto* const part : {&pair.outer, &pair.inner})
    for (const Vec3& u : *part) pair.sizes = pair.sizes + magnitudes(u);
  const std::vector<Vec3>& u = pair.outer;
  const auto other = std::find_if(u.begin(), u.end(), [&](Vec3 v) { return !are_parallel(u[0], v); });
  if (other == u.end()) return segment_encloses(pair);
  if (std::all_of(u.begin(), u.end(), [&](Vec3 v) { return sign_of_det(u[0], *other, v) == 0; })) {
    const ExactVec plane = cross(exact(u[0]), exact(*other));
    return reaches_exactly(pair, plane) && std::all_of(u.begin(), u.end(), [&](Vec3 v) {
             return reaches_exactly(pair, cross(plane, exact(v)));
           });
  }
  for (std::size_t i = 0; i < u.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!reaches(pair, u[i], u[j])) return false;
  return true;
}

}  // namespace dch::zonotope
