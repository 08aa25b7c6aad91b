// SPDX-License-Identifier: MIT
#include <cstddef>

#include <dch/geometry/separating_axes.hpp>
#include <dch/zonotope/membership.hpp>

#include "gjk_search.hpp"
#include "membership_question.hpp"
#include "question.hpp"

namespace dch::zonotope {
namespace {

/// Few generators have few axes, and most zonotopes that are apart are so along one of the first.
bool is_apart_by_axes(const Question& question) {
  if (question.generators.size() > kMaxAxisGenerators) return false;
  const Vec3 tail = magnitudes(question.tail);
  return zonotope_is_apart(question.point, question.generators, tail.x + (tail.y + tail.z));
}

bool answer(const Question& question, Method method, MembershipStats* stats) {
  MembershipStats unused;
  MembershipStats& count = stats != nullptr ? *stats : unused;
  if (method == Method::automatic) {
    if (is_apart_by_axes(question)) {
      ++count.by_axes;
      return false;
    }
    const ClosestPoint closest = closest_point(question, {}, true);
    const bool is_out = closest.lower_bound > 0 && is_separated(question, closest.last_direction);
    if (is_out || is_in_simplex(question, closest.simplex)) {
      ++count.by_gjk;
      return !is_out;
    }
  }
  MetFacet facet;
  if (method != Method::exact) {
    facet = facet_towards(question);
    count.rounds += facet.rounds;
    count.operations += facet.operations;
    if (facet.i != SIZE_MAX) {
      const bool is_out = is_separated(question, facet.normal);
      if (is_out || (facet.j != SIZE_MAX && is_inside(question, facet.normal, facet.i, facet.j))) {
        ++count.by_point_location;
        return !is_out;
      }
    }
  }
  ++count.exact;
  return exact_reach(question, facet.i, facet.j).contains();
}

}  // namespace

bool contains(const Zonotope& z, Vec3 point, Method method, MembershipStats* stats) {
  return answer(question_of_point(z, point), method, stats);
}

bool intersect(const Zonotope& a, const Zonotope& b, Method method, MembershipStats* stats) {
  return answer(question_of_two(a, b), method, stats);
}

}  // namespace dch::zonotope
