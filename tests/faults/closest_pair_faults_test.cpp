// SPDX-License-Identifier: MIT
//
// Memory runs out while a closest pair is kept up or followed through time: it is found again when asked
// again, or what follows it goes on no further, and says so.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/kinetic/kinetic_closest_pair.hpp>
#include <dch/proximity/kept_closest_pair.hpp>

#include "random.hpp"
#include "scene.hpp"

namespace dch::faults {
namespace {

using kinetic::FlightPlan;

/// What has thrown finds the same pair when asked again; all points, or those that changed alone.
TEST(ClosestPairFaults, OneThatIsKept) {
  struct Subject {
    Hierarchy hierarchy{params_for()};
    KeptClosestPair kept;
    ClosestPoints found;
  };
  const auto make = [] {
    const Scene scene(60);
    auto subject = std::make_unique<Subject>();
    subject->hierarchy.build(scene.points, scene.box);
    subject->kept.find(subject->hierarchy.kept_view());
    subject->hierarchy.remove(7);
    subject->hierarchy.insert({0.1, 0.2, 0.3});
    subject->hierarchy.insert({0.1, 0.2, 0.4});
    subject->hierarchy.kept_view();
    return subject;
  };
  const auto find_all = [](auto& subject) {
    subject->found = subject->kept.find(subject->hierarchy.kept_view());
  };
  const auto find_changed = [](auto& subject) {
    subject->found = subject->kept.find(subject->hierarchy.kept_view(), std::vector<std::int32_t>{7, 60});
  };
  const auto find_anew = [](auto& subject) {
    KeptClosestPair other;
    subject->found = other.find(subject->hierarchy.view());
  };
  const auto expected = make();
  find_all(expected);
  const auto fault_of = [&](auto& subject, Ending ending) -> std::string {
    if (ending == Ending::threw) find_changed(subject);
    const bool is_same = subject->found.a == expected->found.a && subject->found.b == expected->found.b;
    return is_same ? "" : after(ending, "another pair");
  };
  expect_sound(sweep(make, find_all, fault_of), 2);
  expect_sound(sweep(make, find_changed, fault_of), 2);
  expect_sound(sweep(make, find_anew, fault_of), 5);
}

std::unique_ptr<kinetic::KineticClosestPair> make_closest_pair() {
  scenes::Random random(73);
  std::vector<FlightPlan> plans;
  for (int k = 0; k < 12; ++k) plans.push_back({0, random.in_cube(2), random.in_cube(2), {}});
  return std::make_unique<kinetic::KineticClosestPair>(Box::orthorhombic({4, 4, 4}), plans, 0);
}

TEST(ClosestPairFaults, AStepThatIsBrokenOffIsTheLast) {
  const auto move = [](auto& closest) {
    closest->advance_to(0.5);
    closest->set_motion(3, {1, 2, 3});
    closest->advance_to(1);
  };
  const auto moved = make_closest_pair();
  move(moved);
  const SweepResult result = sweep([] { return make_closest_pair(); }, move,
                                   [&](auto& closest, Ending ending) -> std::string {
                                     if (ending == Ending::returned)
                                       return closest->pair() == moved->pair() ? "" : "another pair";
                                     try {
                                       closest->step(2);
                                     } catch (const InvalidParameter&) {
                                       return "";
                                     }
                                     return "it goes on";
                                   });
  expect_sound(result, 5);
}

TEST(ClosestPairFaults, ThereIsNothingOrAllAtTheStart) {
  const auto expected = make_closest_pair();
  const SweepResult result =
      sweep([] { return std::unique_ptr<kinetic::KineticClosestPair>(); },
            [](auto& closest) { closest = make_closest_pair(); },
            [&](auto& closest, Ending) {
              return closest == nullptr || closest->pair() == expected->pair() ? "" : "another pair";
            });
  expect_sound(result, 10);
}

}  // namespace
}  // namespace dch::faults
