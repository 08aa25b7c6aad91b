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

#include <dch/engines/pair_search.hpp>
#include <dch/kinetic/contacts_between.hpp>
#include <dch/kinetic/kinetic_hierarchy.hpp>
#include <dch/kinetic/sphere_growth.hpp>

namespace dch::kinetic {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed = 1) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vec3 in_cube(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }

 private:
  std::mt19937_64 engine_;
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

/// Two frames of points between which each moves by up to a share of the cutoff along each axis.
struct TwoFrames {
  TwoFrames(std::int64_t least, double way) : scene(least, 0.45), box(scene.params.box) {
    Random random;
    for (const FlightPlan& plan : scene.plans) {
      before.push_back(plan.position + random.in_cube(0.3));
      after.push_back(before.back() + random.in_cube(way));
    }
  }
  Spheres scene;
  Box box;
  std::vector<Vec3> before, after;
};

/// The same contacts three times: what the list of a frame alone costs; the list and closed forms of the
/// interval; the events of points in linear motion. An item is an interval.
void list_of_a_frame(benchmark::State& state) {
  TwoFrames frames(state.range(0), 0.01 * static_cast<double>(state.range(1)));
  HierarchyParams structure;
  structure.radius = 1.25;
  const auto search = make_search("auto", structure);
  ListParams params;
  params.cutoffs = TypeCutoffs(1.25);
  NeighborList list;
  for (auto _ : state) {
    search->update(frames.before, frames.box);
    search->list(params, list);
    frames.before.swap(frames.after);
  }
  state.SetItemsProcessed(state.iterations());
}

std::int64_t count_events(const PassingContacts& found) {
  std::int64_t events = 0;
  for (const PassingContact& contact : found.contacts)
    events += (contact.is_shown_before ? 0 : 1) + (contact.is_shown_after ? 0 : 1);
  return events;
}

void contacts_between(benchmark::State& state) {
  const TwoFrames frames(state.range(0), 0.01 * static_cast<double>(state.range(1)));
  ContactsBetween between(1.25);
  std::int64_t events = 0;
  for (auto _ : state)
    events = count_events(between.find(frames.before, frames.box, frames.after, frames.box));
  state.counters["events"] = static_cast<double>(events);
  state.SetItemsProcessed(state.iterations());
}

void events_between(benchmark::State& state) {
  const TwoFrames frames(state.range(0), 0.01 * static_cast<double>(state.range(1)));
  KineticParams params;
  params.box = frames.box;
  params.cutoff = 1.25;
  std::vector<FlightPlan> plans;
  for (std::size_t k = 0; k < frames.before.size(); ++k)
    plans.push_back({0, frames.before[k], frames.box.nearest_image(frames.after[k] - frames.before[k]), {}});
  std::int64_t events = 0;
  for (auto _ : state) {
    events = 0;
    const auto edges = make_kinetic_edges(params, plans, 0);
    edges->advance_to(1, [&](const EdgeEvent&) { ++events; });
  }
  ContactsBetween between(1.25);
  if (events != count_events(between.find(frames.before, frames.box, frames.after, frames.box)))
    state.SkipWithError("both tell of other events");
  state.counters["events"] = static_cast<double>(events);
  state.SetItemsProcessed(state.iterations());
}
void intervals(benchmark::internal::Benchmark* benchmark) {
  for (const int way : {2, 20, 100}) benchmark->Args({10648, way});
  benchmark->Args({97336, 20})->Args({64, 20})->Unit(benchmark::kMillisecond);
}
BENCHMARK(list_of_a_frame)->Apply(intervals);
BENCHMARK(contacts_between)->Apply(intervals);
BENCHMARK(events_between)->Apply(intervals);

double half_of_cube(std::int64_t points, int octaves) {
  return std::ldexp(1.5 * std::cbrt(static_cast<double>(points)), octaves);
}

/// Points of a cube that fly through it and on, until they have been past each other. On their way the cube
/// shrinks by so many octaves, and grows again: so all pairs pass the distances of as many more levels.
std::vector<FlightPlan> passing_plans(std::int64_t points, int octaves, Random random) {
  const double shrunk = std::ldexp(1, -octaves);
  const double half = half_of_cube(points, octaves);
  std::vector<FlightPlan> plans;
  for (std::int64_t k = 0; k < points; ++k) {
    const Vec3 at = random.in_cube(half);
    plans.push_back({0, at, random.in_cube(shrunk) - (1 / half) * at, {}});
  }
  return plans;
}

/// Motion is linear, so no distance is larger in between than at both ends of a span.
double largest_distance(const KineticEdges& points) {
  double largest2 = 0;
  const auto count = static_cast<std::int32_t>(points.size());
  for (std::int32_t a = 0; a < count; ++a)
    for (std::int32_t b = a + 1; b < count; ++b)
      largest2 = std::max(largest2, norm2(points.position(b) - points.position(a)));
  return std::sqrt(largest2);
}

void count_events_of_reference(benchmark::State& state, int octaves, std::uint64_t seed) {
  const auto points = static_cast<double>(state.range(0));
  const std::vector<FlightPlan> plans = passing_plans(state.range(0), octaves, Random(seed));
  KineticParams params;
  params.cutoff = 1;
  KineticCounters counted;
  int levels = 0;
  double alpha = 0;
  for (auto _ : state) {
    const auto hierarchy = make_kinetic_hierarchy(params, plans, 0);
    levels = hierarchy->levels();
    alpha = largest_distance(*hierarchy) / params.cutoff;
    hierarchy->advance_to(6 * half_of_cube(state.range(0), octaves));
    if (!hierarchy->validate().empty()) state.SkipWithError("the hierarchy is not valid");
    levels = std::max(levels, hierarchy->levels());
    alpha = std::max(alpha, largest_distance(*hierarchy) / params.cutoff);
    counted = hierarchy->counters();
  }
  const auto events = static_cast<double>(counted.events());
  state.SetItemsProcessed(state.iterations() * counted.events());
  state.counters["events"] = events;
  state.counters["external"] = static_cast<double>(counted.external);
  state.counters["levels"] = levels;
  state.counters["lg_alpha"] = std::log2(alpha);
  state.counters["over_n2_levels"] = events / (points * points * levels);
  state.counters["certificates_a_point"] = static_cast<double>(counted.most_certificates) / points;
  state.counters["made_an_event"] = static_cast<double>(counted.made) / events;
}

void reference_counts(benchmark::State& state) { count_events_of_reference(state, 0, 1); }
BENCHMARK(reference_counts)->Arg(25)->Arg(50)->Arg(100)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond);

/// The same of other sets of as many points, and of sets that shrink.
void reference_seeds(benchmark::State& state) {
  count_events_of_reference(state, static_cast<int>(state.range(1)),
                            static_cast<std::uint64_t>(state.range(2)));
}
BENCHMARK(reference_seeds)
    ->ArgsProduct({{25, 50, 100, 200}, {0}, {2, 3}})
    ->ArgsProduct({{50}, {4, 8, 16, 24}, {1, 2, 3}})
    ->ArgsProduct({{25, 100, 200}, {16}, {1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dch::kinetic

BENCHMARK_MAIN();
