// SPDX-License-Identifier: MIT
#include "membership_question.hpp"

namespace dch::zonotope {
namespace {

/// What a - b, rounded to difference, lacks (D. E. Knuth): exact.
double lost(double a, double b, double difference) {
  const double back = a - difference;
  return (a - (difference + back)) + (back - b);
}

Question question_of(Vec3 point, Vec3 center) {
  Question question;
  question.point = point - center;
  question.tail = {lost(point.x, center.x, question.point.x), lost(point.y, center.y, question.point.y),
                   lost(point.z, center.z, question.point.z)};
  return question;
}

void add_generators(Question& question, const Zonotope& z) {
  for (const Vec3& v : z.generators)
    if (v != Vec3{}) question.generators.push_back(v);
}

}  // namespace

Question question_of_point(const Zonotope& z, Vec3 point) {
  check(z);
  check({point, {}});
  Question question = question_of(point, z.center);
  add_generators(question, z);
  return question;
}

Question question_of_two(const Zonotope& a, const Zonotope& b) {
  check(a);
  check(b);
  Question question = question_of(b.center, a.center);
  add_generators(question, a);
  add_generators(question, b);
  return question;
}

}  // namespace dch::zonotope
