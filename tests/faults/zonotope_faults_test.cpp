// SPDX-License-Identifier: MIT
//
// Memory runs out while questions about zonotopes are answered: there is no answer then, never a wrong one.
#include <functional>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <vector>

#include <dch/zonotope/face_walk.hpp>
#include <dch/zonotope/faces.hpp>
#include <dch/zonotope/gjk.hpp>
#include <dch/zonotope/membership.hpp>
#include <dch/zonotope/norm.hpp>
#include <dch/zonotope/order_reduction.hpp>
#include <dch/zonotope/space_time.hpp>
#include <dch/zonotope/zonogon.hpp>
#include <dch/zonotope/zonotope_index.hpp>

#include "random.hpp"
#include "sweep.hpp"

namespace dch::faults {
namespace {

using namespace zonotope;

struct Question {
  std::string name;
  std::function<double()> ask;
};
std::ostream& operator<<(std::ostream& out, const Question& question) { return out << question.name; }

Zonotope some_zonotope(std::uint64_t seed) {
  scenes::Random random(seed);
  Zonotope z{random.in_cube(1), {}};
  for (int k = 0; k < 6; ++k) z.generators.push_back(random.in_cube(1));
  return z;
}

std::vector<Question> questions() {
  const Zonotope a = some_zonotope(1), b = some_zonotope(2);
  std::vector<Vec2> points;
  for (const Vec3& v : a.generators) points.push_back({v.x, v.y});
  return {{"canonical", [=] { return canonical(a).generators[0].x; }},
          {"sum",
           [=] {
             return support(sum(a, b), {1, 2, 3});
           }},
          {"facets", [=] { return static_cast<double>(facets(canonical(a)).size()); }},
          {"contains",
           [=] {
             return contains(a, {0.1, 0.2, 0.3}) ? 1.0 : 0.0;
           }},
          {"by_point_location",
           [=] {
             return contains(a, {0.1, 0.2, 0.3}, Method::point_location) ? 1.0 : 0.0;
           }},
          {"exact", [=] { return intersect(a, b, Method::exact) ? 1.0 : 0.0; }},
          {"encloses", [=] { return encloses(sum(a, b), a) ? 1.0 : 0.0; }},
          {"norm",
           [=] {
             return norm(a, {1, 2, 3});
           }},
          {"distance", [=] { return distance(a, b).distance; }},
          {"zonogon", [=] { return area(min_area_zonogon(points)); }},
          {"approximated",
           [=] {
             return support(approximated(a, 0.9).zonotope, {1, 2, 3});
           }},
          {"reduced", [=] { return volume(reduced(a, 4)); }},
          {"meeting",
           [=] {
             return first_meeting(a, {{1, 2, 3}, {}, {0, 0, 1}, 1}, b, {}, 0.01).from;
           }},
          {"walk",
           [=] {
             return FaceWalk(a).move_to({1, 2, 3});
           }},
          {"index", [=] {
             return ZonotopeIndex(a, 12).norm({1, 2, 3});
           }}};
}

class ZonotopeFaults : public ::testing::TestWithParam<Question> {};

TEST_P(ZonotopeFaults, ThereIsNoAnswerOrTheRightOne) {
  constexpr double kNone = -1e300;
  const double expected = GetParam().ask();
  const SweepResult result =
      sweep([] { return kNone; }, [](double& answer) { answer = GetParam().ask(); },
            [&](double answer, Ending ending) {
              return answer == (ending == Ending::returned ? expected : kNone) ? "" : "a wrong answer";
            });
  expect_sound(result, 1);
}

INSTANTIATE_TEST_SUITE_P(Questions, ZonotopeFaults, ::testing::ValuesIn(questions()),
                         [](const auto& question) { return question.param.name; });

}  // namespace
}  // namespace dch::faults
