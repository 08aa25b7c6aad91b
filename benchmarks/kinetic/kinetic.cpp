// SPDX-License-Identifier: MIT
//
// Events of moving points: elastic spheres that change two plans at each collision, points that pass through
// each other, and what the reference counts (thesis 5.5.2).
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include <dch/kinetic/kinetic_hierarchy.hpp>

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

double energy(const KineticEdges& spheres) {
  double sum = 0;
  for (std::int32_t id = 0; id < static_cast<std::int32_t>(spheres.size()); ++id)
    sum += norm2(velocity_at(spheres.plan(id), spheres.now()));
  return sum;
}

/// Lets time pass to the next collision and turns both spheres. The edge vanishes at the same time.
void collide(KineticEdges& spheres) {
  for (;;) {
    const auto event = spheres.step(1e9);
    if (!event->appears) continue;
    const auto [a, b] = event->edge;
    const Vec3 d = spheres.box().nearest_image(spheres.position(b) - spheres.position(a));
    const Vec3 u = spheres.plan(a).velocity, v = spheres.plan(b).velocity;
    const Vec3 kick = (dot(v - u, d) / norm2(d)) * d;
    spheres.set_motion(a, u + kick);
    spheres.set_motion(b, v - kick);
    return;
  }
}

void elastic_spheres(benchmark::State& state) {
  const Spheres scene(state.range(0), 0.45);
  const auto spheres = make_kinetic_edges(scene.params, scene.plans, 0);
  const double before = energy(*spheres);
  for (std::size_t k = 0; k < 10 * scene.plans.size(); ++k) collide(*spheres);  // off the lattice
  for (auto _ : state) collide(*spheres);
  if (std::abs(energy(*spheres) / before - 1) > 1e-10) state.SkipWithError("energy is not conserved");
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(elastic_spheres)->Arg(500)->Arg(10648)->Arg(97336)->Unit(benchmark::kMicrosecond);

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
