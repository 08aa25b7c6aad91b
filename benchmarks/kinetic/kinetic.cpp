// SPDX-License-Identifier: MIT
//
// Collisions of hard spheres, events of points that pass through each other, and what the reference counts
// (thesis 5.5.2).
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include <dch/kinetic/kinetic_hierarchy.hpp>
#include <dch/kinetic/sphere_growth.hpp>

namespace dch::kinetic {
namespace {

class Random {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vec3 in_cube(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }

 private:
  std::mt19937_64 engine_{1};
};

/// Spheres of diameter 1 on a simple cubic lattice, at a packing fraction.
struct Spheres {
  Spheres(std::int64_t least, double fraction) {
    const int side = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(least))));
    const double spacing = std::cbrt(std::numbers::pi / 6 / fraction);
    params.box = Box::orthorhombic({side * spacing, side * spacing, side * spacing});
    params.cutoff = 1;
    Random random;
    for (int k = 0; k < side * side * side; ++k)
      plans.push_back({0,
                       spacing * Vec3{1.0 * (k % side), 1.0 * (k / side % side), 1.0 * (k / side / side)},
                       random.in_cube(1),
                       {}});
  }
  KineticParams params;
  std::vector<FlightPlan> plans;
};

void collide(HardSpheres& spheres, std::size_t times) {
  for (std::size_t k = 0; k < times; ++k) spheres.step(1e9);
}

/// Checks, too, that what was measured are collisions of spheres that stay apart.
void measure(benchmark::State& state, HardSpheres& spheres) {
  const double before = spheres.energy();
  collide(spheres, 20 * spheres.size());  // off the lattice, and until lists have the lengths that pay
  for (auto _ : state) spheres.step(1e9);
  if (std::abs(spheres.energy() / before - 1) > 1e-10) state.SkipWithError("energy is not conserved");
  if (spheres.least_gap() < -1e-12) state.SkipWithError("spheres overlap");
  state.SetItemsProcessed(state.iterations());
}

void equal_spheres(benchmark::State& state) {
  const Spheres scene(state.range(0), 0.45);
  std::vector<Vec3> positions, velocities;
  for (const FlightPlan& plan : scene.plans) {
    positions.push_back(plan.position);
    velocities.push_back(plan.velocity);
  }
  HardSphereParams params;
  params.box = scene.params.box;
  params.radii.assign(positions.size(), 0.5);
  HardSpheres spheres(params, positions, velocities);
  measure(state, spheres);
}
BENCHMARK(equal_spheres)->Arg(500)->Arg(10648)->Arg(97336)->Unit(benchmark::kMicrosecond);

/// As many of one size as of the other, 1 to `ratio`, that have grown to the packing fraction.
void unlike_spheres(benchmark::State& state) {
  Spheres scene(state.range(0), std::numbers::pi / 6 * 0.99);
  std::shuffle(scene.plans.begin(), scene.plans.end(), std::mt19937_64(2));
  HardSphereParams params;
  params.box = scene.params.box;
  std::vector<Vec3> positions, velocities;
  for (std::size_t k = 0; k < scene.plans.size(); ++k) {
    params.radii.push_back(k % 2 == 0 ? 0.49 : 0.49 / static_cast<double>(state.range(1)));
    params.masses.push_back(std::pow(2 * params.radii.back(), 3));
    positions.push_back(scene.plans[k].position);
    velocities.push_back((1 / std::sqrt(params.masses.back())) * scene.plans[k].velocity);
  }
  HardSpheres spheres(params, positions, velocities);
  grow(spheres, {1, 0.45, 1e6});
  measure(state, spheres);
}
BENCHMARK(unlike_spheres)
    ->Args({500, 10})
    ->Args({19683, 10})
    ->Args({19683, 20})
    ->Unit(benchmark::kMicrosecond);

void passing_points(benchmark::State& state) {
  const Spheres scene(state.range(0), 0.45);
  const auto points = make_kinetic_edges(scene.params, scene.plans, 0);
  for (auto _ : state) points->step(1e9);
  for (const Edge edge : points->edges())
    if (points->box().distance2(points->position(edge.a), points->position(edge.b)) > 1 + 1e-9)
      state.SkipWithError("an edge is too long");
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(passing_points)->Arg(500)->Arg(10648)->Arg(97336)->Unit(benchmark::kMicrosecond);

/// Points of a cube that fly through it and on, until they have been past each other.
void reference_counts(benchmark::State& state) {
  const auto points = static_cast<double>(state.range(0));
  const double half = 1.5 * std::cbrt(points);
  Random random;
  std::vector<FlightPlan> plans;
  for (std::int64_t k = 0; k < state.range(0); ++k) {
    const Vec3 at = random.in_cube(half);
    plans.push_back({0, at, random.in_cube(1) - (1 / half) * at, {}});
  }
  KineticParams params;
  params.cutoff = 1;
  KineticCounters counted;
  int levels = 0;
  for (auto _ : state) {
    const auto hierarchy = make_kinetic_hierarchy(params, plans, 0);
    levels = hierarchy->levels();
    hierarchy->advance_to(6 * half);
    if (!hierarchy->validate().empty()) state.SkipWithError("the hierarchy is not valid");
    levels = std::max(levels, hierarchy->levels());
    counted = hierarchy->counters();
  }
  const auto events = static_cast<double>(counted.events());
  state.SetItemsProcessed(state.iterations() * counted.events());
  state.counters["events"] = events;
  state.counters["external"] = static_cast<double>(counted.external);
  state.counters["over_n2_levels"] = events / (points * points * levels);
  state.counters["certificates_a_point"] = static_cast<double>(counted.most_certificates) / points;
  state.counters["made_an_event"] = static_cast<double>(counted.made) / events;
}
BENCHMARK(reference_counts)->Arg(25)->Arg(50)->Arg(100)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dch::kinetic

BENCHMARK_MAIN();
