// SPDX-License-Identifier: MIT
//
// The finder of crossings on melts of bead-spring chains, whose beads move by a random vector at each step.
// The argument is the number of chains of 100 beads; steps of 0.1 at most, which is about what ten steps of
// dynamics make. Counters: pairs of bonds a bond, what rejects them, bytes a bond. And each filter alone on
// near pairs.
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <dch/necklace/crossings.hpp>
#include <dch/necklace/melt.hpp>

#include "crossing/encounter.hpp"

namespace dch::bench {
namespace {

using necklace::CrossingFinder;
using necklace::detail::BondSweep;

class Shake {
 public:
  Vec3 vector(double largest) {
    const auto uniform = [&] { return largest * (2 * static_cast<double>(engine_() >> 11) * 0x1p-53 - 1); };
    const double x = uniform(), y = uniform();
    return {x, y, uniform()};
  }

 private:
  std::mt19937_64 engine_{1};
};

necklace::Melt melt_of(std::int64_t chains) {
  necklace::MeltParams params;
  params.chains = static_cast<std::int32_t>(chains);
  return necklace::make_melt(params);
}

/// Two frames in turn, so that steps go there and back.
void finder(benchmark::State& state) {
  const necklace::Melt melt = melt_of(state.range(0));
  Shake shake;
  std::vector<Vec3> moved = melt.positions;
  for (Vec3& p : moved) p = p + shake.vector(0.06);
  CrossingFinder finder(necklace::Chains::from_bonds(melt.positions.size(), melt.bonds));
  finder.start(melt.positions, melt.box);
  necklace::StepCrossings last;
  bool there = false;
  std::size_t events = 0;
  for (auto _ : state) {
    there = !there;
    const auto& found = finder.step(there ? moved : melt.positions, melt.box);
    if (events != 0 && found.crossings.size() != events) state.SkipWithError("there and back differ");
    events = found.crossings.size();
    last.stats = found.stats;
  }
  const auto& stats = last.stats;
  const auto bonds = static_cast<double>(stats.bonds), near = static_cast<double>(stats.near_pairs);
  state.counters["bonds_per_second"] =
      benchmark::Counter(bonds * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["pairs_a_bond"] = near / bonds;
  state.counters["ball"] = static_cast<double>(stats.by_ball) / near;
  state.counters["box"] = static_cast<double>(stats.by_box) / near;
  state.counters["zonotope"] = static_cast<double>(stats.by_zonotope) / near;
  state.counters["left"] =
      static_cast<double>(stats.near_pairs - stats.by_ball - stats.by_box - stats.by_zonotope) / near;
  state.counters["events"] = static_cast<double>(events);
  state.counters["bytes_a_bond"] = static_cast<double>(finder.memory_bytes()) / bonds;
}
BENCHMARK(finder)->Arg(50)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

struct Pair {
  BondSweep p, q;
  Vec3 between;
  necklace::MovingBond bond_p, bond_q;
};

/// Bonds whose midpoints are within 1.2 of each other, as in a melt; 1,000 pairs.
std::vector<Pair> near_pairs() {
  Shake shake;
  std::vector<Pair> pairs;
  while (pairs.size() < 1000) {
    const auto bond = [&](Vec3 center) {
      Vec3 half = shake.vector(1);
      while (norm2(half) > 1 || norm2(half) < 0.01) half = shake.vector(1);
      half = (0.485 / std::sqrt(norm2(half))) * half;
      const Vec3 a = center - half, b = center + half;
      return necklace::MovingBond{a, b, a + shake.vector(0.06), b + shake.vector(0.06)};
    };
    const auto p = bond({}), q = bond(shake.vector(1.2));
    const BondSweep sweep_p(p), sweep_q(q);
    const Vec3 between = sweep_q.center - sweep_p.center;
    if (norm2(between) < 1.44) pairs.push_back({sweep_p, sweep_q, between, p, q});
  }
  return pairs;
}

/// How many near pairs a filter alone rejects, and in what time.
template <class Filter>
void each(benchmark::State& state, const Filter& rejects) {
  const std::vector<Pair> pairs = near_pairs();
  std::int64_t rejected = 0;
  for (auto _ : state) {
    rejected = 0;
    for (const Pair& pair : pairs) rejected += rejects(pair) ? 1 : 0;
    benchmark::DoNotOptimize(rejected);
  }
  const auto count = static_cast<double>(pairs.size());
  std::int64_t crossings = 0;
  for (const Pair& pair : pairs) {
    const auto encounter = necklace::bond_encounter(pair.bond_p, pair.bond_q);
    if (encounter.count == 0) continue;
    ++crossings;
    if (rejects(pair)) state.SkipWithError("a crossing is rejected");
  }
  state.counters["rejected"] = static_cast<double>(rejected) / (count - static_cast<double>(crossings));
  state.counters["crossings"] = static_cast<double>(crossings);
  state.counters["pairs"] =
      benchmark::Counter(count * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void each_ball(benchmark::State& state) {
  each(state, [](const Pair& pair) {
    const double reach = pair.p.radius() + pair.q.radius();
    return norm2(pair.between) > reach * reach;
  });
}
void each_box(benchmark::State& state) {
  each(state, [](const Pair& pair) { return is_apart_by_box(pair.p, pair.q, pair.between, 0); });
}
void each_zonotope(benchmark::State& state) {
  each(state, [](const Pair& pair) { return is_apart_by_zonotope(pair.p, pair.q, pair.between, 0); });
}
/// The whole narrow phase.
void each_encounter(benchmark::State& state) {
  each(state, [](const Pair& pair) { return necklace::bond_encounter(pair.bond_p, pair.bond_q).count == 0; });
}
BENCHMARK(each_ball);
BENCHMARK(each_box);
BENCHMARK(each_zonotope);
BENCHMARK(each_encounter);

}  // namespace
}  // namespace dch::bench

BENCHMARK_MAIN();
