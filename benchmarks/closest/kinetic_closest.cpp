// SPDX-License-Identifier: MIT
//
// The closest pair of points that fly through a box, at every time: events, and what is counted
// (thesis 5.5.2, 5.6.10).
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <dch/kinetic/kinetic_closest_pair.hpp>

namespace dch::kinetic {
namespace {

/// Uniform, one point in a unit of volume.
void flying_points(benchmark::State& state) {
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const double side = std::cbrt(static_cast<double>(state.range(0)));
  std::vector<FlightPlan> plans;
  for (std::int64_t k = 0; k < state.range(0); ++k)
    plans.push_back({0,
                     {uniform(0, side), uniform(0, side), uniform(0, side)},
                     {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)},
                     {}});
  KineticClosestPair closest(Box::orthorhombic({side, side, side}), plans, 0);
  const ClosestCounters before = closest.counters();
  double most_of_a_point = 0;
  for (auto _ : state) closest.step(1e9);
  const double least = closest.distance();
  for (std::int32_t a = 0; a < state.range(0); ++a) {
    most_of_a_point = std::max(most_of_a_point, static_cast<double>(closest.certificates_of(a)));
    for (std::int32_t b = a + 1; b < state.range(0) && a < 100; ++b)
      if (std::sqrt(closest.box().distance2(closest.position(a), closest.position(b))) < least - 1e-9)
        state.SkipWithError("another pair is closer");
  }
  const ClosestCounters after = closest.counters();
  const auto changes = static_cast<double>(after.changes - before.changes);
  state.counters["edges_a_point"] = static_cast<double>(after.edges) / static_cast<double>(state.range(0));
  state.counters["certificates_a_point"] =
      static_cast<double>(after.certificates) / static_cast<double>(state.range(0));
  state.counters["most_certificates_of_a_point"] = most_of_a_point;
  state.counters["lost_a_change"] = static_cast<double>(after.lost - before.lost) / changes;
  state.counters["edge_events_a_change"] =
      static_cast<double>(after.edge_events - before.edge_events) / changes;
  state.counters["made_an_event"] =
      static_cast<double>(after.made - before.made) /
      static_cast<double>(after.lost - before.lost + after.edge_events - before.edge_events);
  state.counters["cutoffs"] = static_cast<double>(after.cutoffs);
}
BENCHMARK(flying_points)->Arg(500)->Arg(5000)->Arg(50000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace dch::kinetic

BENCHMARK_MAIN();
