// SPDX-License-Identifier: MIT
//
// Memory runs out while edges of moving points are made or followed: then they are followed no further, and
// say so, or go on as if nothing had been.
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <dch/kinetic/contacts_between.hpp>
#include <dch/kinetic/hard_spheres.hpp>
#include <dch/kinetic/kinetic_hierarchy.hpp>
#include <dch/kinetic/sphere_growth.hpp>

#include "random.hpp"
#include "sweep.hpp"

namespace dch::faults {
namespace {

using kinetic::FlightPlan;
using kinetic::KineticEdges;

struct NamedEngine {
  std::string name;
  std::function<std::unique_ptr<KineticEdges>(const kinetic::KineticParams&, const std::vector<FlightPlan>&)>
      make;
};

std::ostream& operator<<(std::ostream& out, const NamedEngine& engine) { return out << engine.name; }

std::vector<NamedEngine> engines() {
  return {
      {"engine", [](const auto& params, const auto& plans) { return make_kinetic_edges(params, plans, 0); }},
      {"reference",
       [](const auto& params, const auto& plans) { return make_kinetic_hierarchy(params, plans, 0); }}};
}

class KineticFaults : public ::testing::TestWithParam<NamedEngine> {
 protected:
  KineticFaults() {
    scenes::Random random(71);
    params_.box = Box::orthorhombic({5, 5, 5});
    params_.cutoff = 1;
    for (int k = 0; k < 8; ++k) plans_.push_back({0, random.in_cube(2), random.in_cube(2), {}});
  }
  std::unique_ptr<KineticEdges> make() const { return GetParam().make(params_, plans_); }
  static void move(KineticEdges& edges) {
    edges.advance_to(0.2);
    edges.set_motion(3, {1, 2, 3});
    edges.advance_to(0.3);
  }

  kinetic::KineticParams params_;
  std::vector<FlightPlan> plans_;
};

TEST_P(KineticFaults, ThereIsNothingOrAllAtTheStart) {
  const auto expected = make()->edges();
  const SweepResult result =
      sweep([] { return std::unique_ptr<KineticEdges>(); }, [&](auto& edges) { edges = make(); },
            [&](auto& edges, Ending) {
              return edges == nullptr || edges->edges() == expected ? "" : "other edges";
            });
  EXPECT_GT(result.allocations, 10);
  EXPECT_TRUE(result.faults.empty()) << result.faults[0];
}

TEST_P(KineticFaults, AStepThatIsBrokenOffIsTheLast) {
  const auto moved = make();
  move(*moved);
  const SweepResult result = sweep([&] { return make(); }, [](auto& edges) { move(*edges); },
                                   [&](auto& edges, Ending ending) -> std::string {
                                     if (ending == Ending::returned)
                                       return edges->edges() == moved->edges() ? "" : "other edges";
                                     try {
                                       edges->step(1);
                                     } catch (const InvalidParameter&) {
                                       return "";
                                     }
                                     return "it goes on";
                                   });
  EXPECT_GT(result.allocations, 5);
  EXPECT_TRUE(result.faults.empty()) << result.faults[0];
}

INSTANTIATE_TEST_SUITE_P(Engines, KineticFaults, ::testing::ValuesIn(engines()),
                         [](const auto& engine) { return engine.param.name; });

/// Some points of two frames of a box that changes a little; the last one moves too far for a list.
struct TwoFrames {
  TwoFrames() {
    scenes::Random random(73);
    for (int k = 0; k < 40; ++k) {
      before.push_back(random.in_cube(2.5));
      after.push_back(before.back() + random.in_cube(0.4));
    }
    after.back() = before.back() + Vec3{2.4, 0, 0};
  }
  std::size_t find(kinetic::ContactsBetween& between) const {
    return between.find(before, Box::orthorhombic({5, 5, 5}), after, Box::orthorhombic({5.01, 5, 5}))
        .contacts.size();
  }
  std::vector<Vec3> before, after;
};

TEST(ContactsBetweenFaults, ASearchThatIsBrokenOffIsMadeAnew) {
  const TwoFrames frames;
  kinetic::ContactsBetween whole(1);
  const std::size_t expected = frames.find(whole);
  EXPECT_GT(expected, 5U);
  for (const char* engine : {"dch", "grid"}) {
    const SweepResult result = sweep(
        [&] { return kinetic::ContactsBetween(1, engine); }, [&](auto& between) { frames.find(between); },
        [&](auto& between, Ending) { return frames.find(between) == expected ? "" : "other contacts"; });
    EXPECT_GT(result.allocations, 20) << engine;
    EXPECT_TRUE(result.faults.empty()) << engine << ": " << result.faults[0];
  }
}

TEST(ContactsBetweenFaults, ThereIsNothingOrAllAtTheStart) {
  const SweepResult result =
      sweep([] { return std::unique_ptr<kinetic::ContactsBetween>(); },
            [](auto& between) { between = std::make_unique<kinetic::ContactsBetween>(1); },
            [](auto&, Ending) { return ""; });
  EXPECT_GT(result.allocations, 2);
  EXPECT_TRUE(result.faults.empty()) << result.faults[0];
}

std::unique_ptr<kinetic::HardSpheres> make_spheres() {
  scenes::Random random(72);
  kinetic::HardSphereParams params;
  params.box = Box::orthorhombic({4, 4, 4});
  std::vector<Vec3> positions, velocities;
  for (int k = 0; k < 27; ++k) {
    positions.push_back({1.3 * (k % 3), 1.3 * (k / 3 % 3), 1.3 * (k / 9)});
    velocities.push_back(random.in_cube(1));
    params.radii.push_back(k % 2 == 0 ? 0.5 : 0.2);
  }
  return std::make_unique<kinetic::HardSpheres>(params, positions, velocities);
}

/// A change of spheres that is broken off is the last; else they are where they would be with memory.
template <class Change>
void sweep_change(const Change& change) {
  const auto moved = make_spheres();
  change(*moved);
  const SweepResult result =
      sweep([] { return make_spheres(); }, [&](auto& spheres) { change(*spheres); },
            [&](auto& spheres, Ending ending) -> std::string {
              if (ending == Ending::returned)
                return spheres->position(5) == moved->position(5) ? "" : "another position";
              try {
                spheres->step(100);
              } catch (const InvalidParameter&) {
                return "";
              }
              return "it goes on";
            });
  EXPECT_GT(result.allocations, 5);
  EXPECT_TRUE(result.faults.empty()) << result.faults[0];
}

TEST(HardSphereFaults, AStepThatIsBrokenOffIsTheLast) {
  sweep_change([](kinetic::HardSpheres& spheres) { spheres.advance_to(5); });
}

TEST(HardSphereFaults, GrowthThatIsBrokenOffIsTheLast) {
  sweep_change([](kinetic::HardSpheres& spheres) {
    kinetic::GrowthParams params;
    params.rate = 0.1;
    params.fraction = 0.2;
    grow(spheres, params);
  });
}

TEST(HardSphereFaults, ThereIsNothingOrAllAtTheStart) {
  const SweepResult result = sweep(
      [] { return std::unique_ptr<kinetic::HardSpheres>(); }, [](auto& spheres) { spheres = make_spheres(); },
      [&](auto& spheres, Ending) {
        return spheres == nullptr || spheres->least_gap() > 0 ? "" : "half of it";
      });
  EXPECT_GT(result.allocations, 10);
  EXPECT_TRUE(result.faults.empty()) << result.faults[0];
}

}  // namespace
}  // namespace dch::faults
