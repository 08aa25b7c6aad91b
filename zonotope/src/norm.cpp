// SPDX-License-Identifier: MIT
#include <limits>

#include <dch/zonotope/norm.hpp>

#include "membership_question.hpp"

namespace dch::zonotope {

double norm(const Zonotope& z, Vec3 x) {
  Question question = question_of_point({{}, z.generators}, x);
  if (x == Vec3{}) return 0;
  const MetFacet found = facet_towards(question);
  if (found.i != SIZE_MAX && found.j != SIZE_MAX && found.support > 0) {
    // Along any normal the zonotope times this reaches as far as x at most; that it reaches x is to be shown.
    const double least = found.height / found.support;
    Question enlarged = question;
    const double scale = 1 / (least * (1 + 1e-12));
    enlarged.point = scale * x;
    if (scale < 1e50 && is_inside(enlarged, found.normal, found.i, found.j)) return least;
  }
  const Reach reach = exact_reach(question, found.i, found.j);
  if (reach.support.sign() == 0) return std::numeric_limits<double>::infinity();
  return reach.height.value() / reach.support.value();
}

double polyhedral_distance(const Zonotope& z, Vec3 p, Vec3 q) { return norm(z, q - p); }

}  // namespace dch::zonotope
