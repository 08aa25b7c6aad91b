// SPDX-License-Identifier: MIT
//
// Cluster pairs and Lennard-Jones forces in the Lennard-Jones melt: density 0.8442, cutoff 2.5, skin 0.3. The
// melt is made here, by running it with the forces that are measured until it has melted. `useful` counts
// pairs within the cutoff. Arguments: atoms along each axis of the cubic start, and the instruction set.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include <dch/base/instruction_set.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "melt.hpp"

namespace {

using melt::kCutoff, melt::kSkin, melt::Melt, melt::request;

Melt& melt_of(std::int64_t cells) {
  static std::map<std::int64_t, Melt> melts;
  return melts.try_emplace(cells, static_cast<int>(cells)).first->second;
}

/// Forces, and how large those of pairs are that rounding may put on either side of the cutoff, where the
/// force jumps.
struct ExactForces {
  std::vector<dch::Vec3> force;
  std::vector<double> in_doubt;
};

/// Forces pair by pair from a neighbor list, in long double: plain double rounds more than what is checked.
/// @param doubt relative error of a squared distance
ExactForces exact_forces(const Melt& melt, double doubt) {
  using Exact = long double;
  constexpr Exact kCutoff2 = Exact{kCutoff} * kCutoff;
  dch::ListParams within = request();
  within.skin = kCutoff * doubt;
  const auto search = dch::make_cell_search(within.list_radius());
  search->update(melt.positions, melt.box);
  const dch::NeighborList list = search->list(within);
  ExactForces exact{std::vector<dch::Vec3>(melt.positions.size()),
                    std::vector<double>(melt.positions.size(), 0.0)};
  std::vector<dch::Vec3>& force = exact.force;
  for (std::size_t i = 0; i < list.size(); ++i)
    for (const std::int32_t j : list.row(i)) {
      Exact d[3], r2 = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const Exact side = melt.box.vector(axis)[axis];
        d[axis] = Exact{melt.positions[static_cast<std::size_t>(j)][axis]} - Exact{melt.positions[i][axis]};
        d[axis] -= side * std::round(d[axis] / side);
        r2 += d[axis] * d[axis];
      }
      const Exact s = 1 / r2, s3 = s * s * s, f = 24 * s3 * s * (2 * s3 - 1);
      if (std::abs(r2 - kCutoff2) <= Exact{doubt} * kCutoff2) {
        const auto size = static_cast<double>(std::abs(f) * std::sqrt(r2));
        exact.in_doubt[i] += size;
        exact.in_doubt[static_cast<std::size_t>(j)] += size;
      }
      if (r2 > kCutoff2) continue;
      for (int axis = 0; axis < 3; ++axis) {
        force[static_cast<std::size_t>(j)][axis] += static_cast<double>(f * d[axis]);
        force[i][axis] -= static_cast<double>(f * d[axis]);
      }
    }
  return exact;
}

/// A benchmark of a wrong answer is void. Returns the root mean square error, relative; what pairs at the
/// very cutoff leave in doubt is no error.
double checked_error(const Melt& melt, dch::ForcePrecision precision) {
  dch::LennardJones potential({1, 1, kCutoff});
  std::vector<dch::Vec3> force(melt.positions.size());
  potential.add_forces(melt.pairs, precision, force);
  const ExactForces exact = exact_forces(melt, precision == dch::ForcePrecision::mixed ? 1e-6 : 1e-14);
  double error2 = 0, size2 = 0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double error = std::sqrt(norm2(force[i] - exact.force[i]));
    const double certain = std::max(0.0, error - exact.in_doubt[i]);
    error2 += certain * certain;
    size2 += norm2(exact.force[i]);
  }
  const double error = std::sqrt(error2 / size2);
  if (error < (precision == dch::ForcePrecision::mixed ? 2e-6 : 1e-14)) return error;
  std::fprintf(stderr, "forces are off by %g of their root mean square; nothing was timed\n", error);
  std::exit(1);
}

/// Uses the set of the benchmark's last argument; false if there is none such here.
bool use_set(benchmark::State& state) {
  const auto set = static_cast<dch::InstructionSet>(state.range(1));
  state.SetLabel(dch::name(set));
  if (!dch::is_supported(set)) {
    state.SkipWithError("not supported by this processor");
    return false;
  }
  dch::set_instruction_set(set);
  return true;
}

/// Slots that kernels look at: of an entry all 16 or those of a half, of two that are joined 16 together.
double slots_of(const dch::ClusterPairs& pairs) {
  using Order = dch::ClusterPairs::EntryOrder;
  double slots = 16 * static_cast<double>(pairs.entries.size());
  for (std::size_t r = 0; r < pairs.parts.size(); ++r)
    slots -= 8 * static_cast<double>(pairs.rows[r + 1].first - pairs.rows[r].first - pairs.parts[r].first);
  return pairs.entry_order == Order::as_found ? 16 * static_cast<double>(pairs.entries.size()) : slots;
}

void count_slots(benchmark::State& state, const Melt& melt) {
  const auto useful = static_cast<double>(melt.useful);
  state.counters["useful/atom"] = useful / melt.atoms();
  state.counters["slots/useful"] = slots_of(melt.pairs) / useful;
}

void report_per(benchmark::State& state, const char* name, double count) {
  state.counters[name] = benchmark::Counter(
      1e-9 * count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// The search alone, at positions of the time, or with the order that forces are computed in.
template <bool orders, dch::ForcePrecision precision>
void cluster_pairs(benchmark::State& state) {
  if (!use_set(state)) return;
  Melt& melt = melt_of(state.range(0));
  dch::HierarchyParams params;
  params.radius = kCutoff + kSkin;
  const auto search = dch::make_dch_search(params);
  search->update(melt.positions, melt.box);
  dch::ClusterPairs pairs;
  for (auto _ : state) {
    search->cluster_pairs(request(), pairs);
    const auto order = dch::LennardJones::wanted_order(precision);
    pairs.refreshes = 0, pairs.refreshes_before = dch::ClusterPairs::steps_to_order(order);
    if (orders) pairs.order_entries(order);
    benchmark::DoNotOptimize(pairs.entries.data());
  }
  report_per(state, "time/atom", melt.atoms());
  count_slots(state, melt);
}

/// The atom-pair list of the same structure, to compare with.
void neighbor_list(benchmark::State& state) {
  if (!use_set(state)) return;
  Melt& melt = melt_of(state.range(0));
  dch::HierarchyParams params;
  params.radius = kCutoff + kSkin;
  const auto search = dch::make_dch_search(params);
  search->update(melt.positions, melt.box);
  dch::ListParams unsorted = request();
  unsorted.order = dch::RowOrder::unsorted;
  dch::NeighborList list;
  for (auto _ : state) {
    search->list(unsorted, list);
    benchmark::DoNotOptimize(list.j.data());
  }
  report_per(state, "time/atom", melt.atoms());
}

void refresh(benchmark::State& state) {
  if (!use_set(state)) return;
  Melt& melt = melt_of(state.range(0));
  for (auto _ : state) {
    melt.pairs.refresh(melt.positions, melt.box);
    benchmark::DoNotOptimize(melt.pairs.at.data());
  }
  report_per(state, "time/atom", melt.atoms());
}

template <dch::ForcePrecision precision, bool sums>
void forces(benchmark::State& state) {
  if (!use_set(state)) return;
  Melt& melt = melt_of(state.range(0));
  melt.search_for(precision);
  state.counters["error"] = checked_error(melt, precision);
  dch::LennardJones potential({1, 1, kCutoff});
  std::vector<dch::Vec3> force(melt.positions.size());
  for (auto _ : state) {
    if (sums) {
      benchmark::DoNotOptimize(potential.add_forces_and_sum(melt.pairs, precision, force).energy);
    } else {
      potential.add_forces(melt.pairs, precision, force);
    }
    benchmark::DoNotOptimize(force.data());
  }
  report_per(state, "time/useful", static_cast<double>(melt.useful));
  count_slots(state, melt);
}

/// The same forces from a table of types.
template <dch::ForcePrecision precision, int types>
void forces_of_types(benchmark::State& state) {
  if (!use_set(state)) return;
  Melt& melt = melt_of(state.range(0));
  melt.search_for(precision);
  dch::LennardJones potential(types, std::vector<dch::LennardJonesPair>(types * types, {1, 1, kCutoff}));
  std::vector<dch::Vec3> force(melt.positions.size());
  for (auto _ : state) {
    potential.add_forces(melt.pairs, precision, force);
    benchmark::DoNotOptimize(force.data());
  }
  report_per(state, "time/useful", static_cast<double>(melt.useful));
}

const std::vector<std::int64_t> kSets{0, 1, 2, 3};

#define DCH_CLUSTER_PAIRS(name, orders, precision)                 \
  BENCHMARK(cluster_pairs<orders, dch::ForcePrecision::precision>) \
      ->Name(name)                                                 \
      ->ArgsProduct({{20}, kSets})                                 \
      ->Args({40, 3})                                              \
      ->Unit(benchmark::kMillisecond)
DCH_CLUSTER_PAIRS("cluster_pairs", false, mixed);
DCH_CLUSTER_PAIRS("cluster_pairs_for_mixed", true, mixed);
DCH_CLUSTER_PAIRS("cluster_pairs_for_full", true, full);
#undef DCH_CLUSTER_PAIRS
BENCHMARK(neighbor_list)->Args({20, 3})->Unit(benchmark::kMillisecond);
BENCHMARK(refresh)->Args({20, 3})->Unit(benchmark::kMillisecond);
#define DCH_FORCES(precision)                                   \
  BENCHMARK(forces<dch::ForcePrecision::precision, false>)      \
      ->Name("forces_" #precision)                              \
      ->ArgsProduct({{20}, kSets})                              \
      ->Args({40, 3})                                           \
      ->Unit(benchmark::kMillisecond);                          \
  BENCHMARK(forces<dch::ForcePrecision::precision, true>)       \
      ->Name("forces_and_sums_" #precision)                     \
      ->Args({20, 3})                                           \
      ->Unit(benchmark::kMillisecond);                          \
  BENCHMARK(forces_of_types<dch::ForcePrecision::precision, 4>) \
      ->Name("forces_of_4_types_" #precision)                   \
      ->ArgsProduct({{20}, kSets})                              \
      ->Unit(benchmark::kMillisecond);                          \
  BENCHMARK(forces_of_types<dch::ForcePrecision::precision, 8>) \
      ->Name("forces_of_8_types_" #precision)                   \
      ->Args({20, 3})                                           \
      ->Unit(benchmark::kMillisecond)
DCH_FORCES(mixed);
DCH_FORCES(full);
#undef DCH_FORCES

}  // namespace

BENCHMARK_MAIN();
